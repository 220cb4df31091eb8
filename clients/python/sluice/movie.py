"""A recording as a movie of a field: MP4 or animated GIF.

python3 -m sluice.movie RUN.h5 -o OUT.mp4|OUT.gif [--field NAME] [--from T] [--until T] [--every N] [--fps N | --speed X]
"""

import shutil
import sys
from pathlib import Path

import numpy as np

from sluice.command import DONE, Parser, add_frames, add_picture, chosen_frames, number, positive, run, scale
from sluice.progress import Bar
from sluice.recording import Recording, RecordingError

SAMPLES = 12  # frames that colours and limits are found from
MOST_FPS = 50  # a GIF's delays are hundredths of a second, and viewers take less than two for ten


def writer(output, fps):
    """Matplotlib's writer for a file name: ffmpeg for .mp4, pillow for .gif."""
    from matplotlib import animation

    kind = output.suffix.lower()
    if kind == ".gif":
        return animation.PillowWriter(fps=fps)
    if kind != ".mp4":
        raise RecordingError(f"{output}: a movie ends in .mp4 or .gif")
    if shutil.which("ffmpeg") is None:
        raise RecordingError(f"{output}: ffmpeg, which makes MP4, is not installed; install Debian's ffmpeg or name a .gif")
    # Players want this pixel format, which wants an even number of pixels either way.
    options = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]
    return animation.FFMpegWriter(fps=fps, codec="libx264", extra_args=options)


def rate(run_, frames, options):
    """Pictures a second."""
    if options.fps is not None:
        return options.fps
    if options.speed is None:
        return 20
    if not options.speed > 0:
        raise RecordingError(f"--speed {options.speed:g} is not positive")
    if len(frames) < 2:
        return 1
    interval = (run_.times[frames[-1]] - run_.times[frames[0]]) / (len(frames) - 1)
    wanted = options.speed / interval
    if wanted > MOST_FPS:
        every = int(np.ceil(wanted / MOST_FPS)) * options.every
        raise RecordingError(
            f"--speed {options.speed:g} needs {wanted:.0f} pictures a second, at most {MOST_FPS}; add --every {every}"
        )
    return wanted


def sampled(frames):
    """Some of the frames, evenly over them and with both ends."""
    return [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, SAMPLES).round().astype(int))]


def film(run_, frames, options, output):
    from sluice import picture, view

    the_view = view.make_view(run_, options.view, options.slice)
    style = picture.Style(options.field or picture.first_field(run_), options.range, options.particles)

    def title(frame):
        return ", ".join(filter(None, [run_.name, picture.time_text(run_, run_.times[frame])]))

    shots = [(run_, frames[0], title(frames[0]))]
    sheet, (panel,) = picture.draw(
        shots, lambda _: the_view, style, sampled=[(run_, frame) for frame in sampled(frames)]
    )
    maker = writer(output, rate(run_, frames, options))
    bar = Bar()
    with maker.saving(sheet.figure, str(output), dpi=picture.DPI * options.scale):
        for done, frame in enumerate(frames):
            panel.show(frame, title(frame))
            maker.grab_frame()
            bar.show((done + 1) / len(frames), f"{done + 1} of {len(frames)} pictures")
    bar.clear()


def arguments(argv):
    parser = Parser(prog="sluice movie", description="Make a movie of a recording.")
    parser.add_argument("recording", metavar="RUN.h5")
    files = "OUT.gif, or OUT.mp4 where ffmpeg is installed"
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help=files)
    add_picture(parser)
    add_frames(parser)
    pace = parser.add_mutually_exclusive_group()
    pace.add_argument("--fps", type=positive, metavar="N", help="pictures a second, 20 by default")
    pace.add_argument("--speed", type=number, metavar="X", help="simulated seconds a second of the movie")
    parser.add_argument("--scale", type=scale, default=0.6, metavar="X", help="size, 0.6 by default: about 800 pixels wide")
    return parser.parse_args(argv)


def main(argv):
    options = arguments(argv)
    output = Path(options.output)
    with Recording(options.recording) as run_:
        frames = chosen_frames(run_, options)
        writer(output, 1)
        film(run_, frames, options, output)
    print(output)
    return DONE


if __name__ == "__main__":
    sys.exit(run("movie", main, sys.argv[1:]))
