#include "validation/capillary_drop/capillary_drop.hpp"
#include "validation/channel_start_up/channel_start_up.hpp"
#include "validation/dam_break/dam_break.hpp"
#include "validation/drop_impact/drop_impact.hpp"
#include "validation/elliptical_drop/elliptical_drop.hpp"
#include "validation/gerstner_wave/gerstner_wave.hpp"
#include "validation/hydrostatic_column/hydrostatic_column.hpp"
#include "validation/interfacial_wave/interfacial_wave.hpp"
#include "validation/jet_on_wall/jet_on_wall.hpp"
#include "validation/lock_exchange/lock_exchange.hpp"
#include "validation/mould_filling/mould_filling.hpp"
#include "validation/perea_wave/perea_wave.hpp"
#include "validation/rotating_patch/rotating_patch.hpp"
#include "validation/sluice_gate/sluice_gate.hpp"
#include "validation/standing_wave/standing_wave.hpp"
#include "validation/taylor_green/taylor_green.hpp"
#include "validation/two_liquid_dam_break/two_liquid_dam_break.hpp"

namespace sluice::validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{hydrostatic_column(),
                                       standing_wave(),
                                       viscous_standing_wave(),
                                       rotating_patch(),
                                       elliptical_drop(),
                                       taylor_green(),
                                       poiseuille_start_up(),
                                       couette_start_up(),
                                       jet_on_wall(),
                                       dam_break(),
                                       drop_impact(),
                                       sluice_gate(),
                                       interfacial_wave_2(),
                                       interfacial_wave_10(),
                                       interfacial_wave_1000(),
                                       lock_exchange(),
                                       two_liquid_dam_break(),
                                       still_drop(),
                                       oscillating_drop(),
                                       oscillating_drop_3d(),
                                       mould_filling(),
                                       gerstner_wave(),
                                       perea_wave()};
  return cases;
}

}  // namespace sluice::validation
