"""Started by samara's programs as `python3 -I -B draw.py JOB OUTPUT SHOWN`: makes the picture or page that the file JOB
describes.

JOB holds JSON: "format" (svg, png or html) with "picture" (as samara.plot.draw takes it) or "page" (as
samara.report.page takes it). Writes OUTPUT, and into SHOWN a JSON object of what the picture shows. The exit status is
3 where a module is missing, which standard error then names. It reads and runs neither
modules beside the caller nor the user's settings of matplotlib. """

import json
import os
import sys
import types

if __name__ == "__main__":
    os.environ.update(MPLBACKEND="Agg", MATPLOTLIBRC=os.devnull)
    # The package without its compiled part, which only notebooks have.
    package = types.ModuleType("samara")
    package.__path__ = [os.path.dirname(os.path.abspath(__file__))]
    sys.modules["samara"] = package
    with open(sys.argv[1], encoding="utf-8") as job_file:
        job = json.load(job_file)
    shown = {}
    try:
        if job["format"] == "html":
            from samara import report
            result = report.page(job["page"]).encode()
            with open(sys.argv[2], "wb") as output:
                output.write(result)
        else:
            from samara import plot
            figure = plot.draw(job["picture"])
            shown = figure.shown
            with open(sys.argv[2], "wb") as output:
                plot.write(figure, output, job["format"])
    except ModuleNotFoundError as missing:
        print(missing.name, file=sys.stderr)
        sys.exit(3)
    with open(sys.argv[3], "w", encoding="utf-8") as answer:
        json.dump(shown, answer)
