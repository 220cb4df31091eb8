"""Pictures of recordings: the liquid coloured by a field, and curves over time.

python3 -m sluice.plot RUN.h5 [MORE.h5 ...] [-o OUT.png] [--time T | --frame N | --times T1,T2,...] [--field NAME]
                       [--probes | --bodies | --energy | --ledger]
"""

import sys
from contextlib import ExitStack
from pathlib import Path

from sluice.command import DONE, Parser, add_picture, number, numbers, run, words
from sluice.recording import Recording, RecordingError

FORMATS = ("png", "svg", "pdf")


def chosen_frames(run_, options):
    if run_.frames == 0:
        raise RecordingError(f"{run_.path} holds no frame")
    if options.times is not None:
        if not options.times:
            raise RecordingError("--times names no time")
        return [run_.frame_at(time) for time in options.times]
    if options.time is not None:
        return [run_.frame_at(options.time)]
    return [int(run_.particle_frames[-1]) if options.frame is None else run_.index(options.frame)]


def labels(runs):
    """What tells the runs apart: nothing for one, else their files' names."""
    if len(runs) == 1:
        return [""]
    names = [run_.path.stem for run_ in runs]
    return names if len(set(names)) == len(names) else [str(run_.path) for run_ in runs]


def draw_fields(runs, options):
    from sluice import picture, view

    if len({run_.dimension for run_ in runs}) > 1:
        raise RecordingError("recordings in two and in three dimensions do not go into one picture")
    shots = []
    for run_, label in zip(runs, labels(runs)):
        for frame in chosen_frames(run_, options):
            shots.append((run_, frame, ", ".join(filter(None, [label, picture.time_text(run_, run_.times[frame])]))))
    title = runs[0].name
    if len(shots) == 1:
        shots = [(run_, frame, f"{title}, {text}".strip(", ")) for run_, frame, text in shots]
        title = ""
    style = picture.Style(options.field or picture.first_field(runs[0]), options.range, options.particles, options.front)
    sheet, _ = picture.draw(shots, lambda run_: view.make_view(run_, options.view, options.slice), style, title)
    return sheet.figure


def draw_curves(runs, options):
    from sluice import curves

    if options.probes is not None:
        what, make = "probes", lambda run_: curves.probe_curves(run_, options.probes)
    elif options.bodies:
        what, make = "bodies", curves.body_curves
    elif options.energy:
        what, make = "energy of the fluid", curves.energy_curves
    else:
        what, make = "ledgers of the bodies", curves.ledger_curves
    for run_ in runs:
        if run_.frames == 0:
            raise RecordingError(f"{run_.path} holds no frame")
    title = f"{runs[0].name}: {what}".strip(": ")
    return curves.draw([(label, make(run_)) for run_, label in zip(runs, labels(runs))], title)


def arguments(argv):
    parser = Parser(prog="sluice plot", description="Draw a recording, or several over each other.")
    parser.add_argument("recordings", nargs="+", metavar="RUN.h5")
    parser.add_argument("-o", "--output", metavar="FILE", help="PNG, SVG or PDF; RUN.png by default")
    when = parser.add_mutually_exclusive_group()
    when.add_argument("--time", type=number, metavar="T", help="the frame nearest to a time [s]; the last by default")
    when.add_argument("--frame", type=int, metavar="N", help="a frame from 0; negative from the end")
    when.add_argument("--times", type=numbers, metavar="T1,T2,...", help="several times in one picture [s]")
    add_picture(parser)
    parser.add_argument("--front", action="store_true", help="mark the foremost particle")
    what = parser.add_mutually_exclusive_group()
    measured = "what the probes measured over time; all or these"
    what.add_argument("--probes", nargs="?", type=words, const=[], metavar="NAME,...", help=measured)
    what.add_argument("--bodies", action="store_true", help="motion of the bodies and forces on them over time")
    what.add_argument("--energy", action="store_true", help="energies over time")
    balance = "impulses on the bodies, work, and what is left of Newton's third law over time"
    what.add_argument("--ledger", action="store_true", help=balance)
    return parser.parse_args(argv)


def main(argv):
    options = arguments(argv)
    output = Path(options.output) if options.output else Path(options.recordings[0]).with_suffix(".png")
    if output.suffix.lstrip(".").lower() not in FORMATS:
        raise RecordingError(f"{output}: a picture ends in .{', .'.join(FORMATS)}")
    with ExitStack() as stack:
        runs = [stack.enter_context(Recording(path)) for path in options.recordings]
        over_time = options.probes is not None or options.bodies or options.energy or options.ledger
        figure = (draw_curves if over_time else draw_fields)(runs, options)
    from sluice.drawing import save

    save(figure, output, dpi=150)
    print(output)
    return DONE


if __name__ == "__main__":
    sys.exit(run("plot", main, sys.argv[1:]))
