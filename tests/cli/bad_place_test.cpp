// Endpoints and files that cannot be used: refused before anything is started, and left as they were.
#include <gmock/gmock.h>

#include <filesystem>

#include "protocol/endpoint.hpp"
#include "tests/cli/command.hpp"
#include "tests/cli/scenes.hpp"

namespace sluice::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BadPlace : public testing::Test {
 protected:
  BadPlace() { directory.write("small.scene", kSmallScene); }
  Outcome run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"run", "small.scene"});
    return run_program("sluice", options, directory.path());
  }
  TemporaryDirectory directory;
};

TEST_F(BadPlace, AnExistingRecordingIsKept) {
  directory.write("out.h5", "precious");
  const Outcome outcome = run({"-o", "out.h5"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("out.h5"), HasSubstr("--force")));
  EXPECT_EQ(read_text(directory.path() / "out.h5"), "precious");
  EXPECT_THAT(directory.list(), ElementsAre("out.h5", "small.scene"));
}

TEST_F(BadPlace, AnUnwritableOutputIsNamed) {
  for (const char* output : {"absent/out.h5", "/proc/out.h5", "."}) {
    const Outcome outcome = run({"-o", output});
    EXPECT_EQ(outcome.code, 1) << output;
    EXPECT_THAT(outcome.err, HasSubstr(output));
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(directory.list(), ElementsAre("small.scene"));
  }
}

TEST_F(BadPlace, AnIpcEndpointInUseIsLeftToItsServer) {
  const std::string endpoint = "ipc://" + (directory.path() / "s").string();
  const protocol::EndpointLock taken(protocol::Endpoint::parse(endpoint));
  const auto before = directory.list();
  const Outcome outcome = run({"-o", "out.h5", "--listen", endpoint});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(endpoint));
  EXPECT_EQ(directory.list(), before);
}

TEST_F(BadPlace, ATcpPortInUseIsNamed) {
  zmq::context_t context;
  zmq::socket_t taken(context, zmq::socket_type::router);
  std::string endpoint;
  for (int port = 47000; endpoint.empty();
       port += 10) {  // the first free one: other programs run beside this
    const std::string candidate = "tcp://127.0.0.1:" + std::to_string(port);
    if (zmq_bind(taken.handle(), candidate.c_str()) == 0) endpoint = candidate;
  }
  const Outcome outcome = run({"-o", "out.h5", "--listen", endpoint});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(endpoint));
  EXPECT_THAT(directory.list(), ElementsAre("small.scene"));
}

TEST_F(BadPlace, AnAddressThatOtherMachinesReachNeedsKeys) {
  const Outcome outcome = run({"--listen", "tcp://0.0.0.0:47900"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("0.0.0.0"), HasSubstr("keygen")));
}

TEST_F(BadPlace, InspectRefusesWhatIsNoRecordingOrCutShort) {
  ASSERT_EQ(run({"-o", "out.h5"}).code, 0);
  const auto size = std::filesystem::file_size(directory.path() / "out.h5");
  std::filesystem::resize_file(directory.path() / "out.h5", size / 2);
  directory.write("text.h5", "no recording");
  for (const char* file : {"out.h5", "text.h5", "absent.h5"}) {
    const Outcome outcome = run_program("sluice", {"inspect", file}, directory.path());
    EXPECT_EQ(outcome.code, 1) << file;
    EXPECT_THAT(outcome.err, HasSubstr(file));
    EXPECT_THAT(outcome.out, IsEmpty()) << file;
  }
}

}  // namespace
}  // namespace sluice::test
