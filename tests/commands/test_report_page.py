"""The page of `breccia report` in a browser: it loads without a complaint and without a network, the slider moves the
solid, other sensors and the wheel change the curve, and it is small.

    test_report_page.py                      what ctest runs: three examples made small
    test_report_page.py --all                every example made small
    test_report_page.py --page FILE ...      these pages; the best of three first views within two seconds
    test_report_page.py --picture FILE PAGE  a picture of the page's upper part, as in docs/images

Needs chromium and python3-websocket (browser.py); skipped (77) where they are missing.
"""
import argparse
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser
import test_resume as small

SIZE = 5e6
FIRST_VIEW = 2000  # [ms]
EXAMPLES = ["plate-impact", "beams-fracture", "tension"]
# The canvas of the view and that of the curves, and the part of their pixels that is darker than some sum of red, green
# and blue: the solid is dark beside rigid bodies, a curve beside paper.
SOLID = "document.querySelector('.solid canvas')"
CURVE = "document.querySelector('#curves .chart canvas')"
PAINTED = """(() => { const from = %s, copy = document.createElement('canvas');
    copy.width = from.width; copy.height = from.height;
    const pen = copy.getContext('2d'); pen.drawImage(from, 0, 0);
    const bytes = pen.getImageData(0, 0, copy.width, copy.height).data; let n = 0;
    for (let k = 0; k < bytes.length; k += 4) n += bytes[k + 3] > 0 && bytes[k] + bytes[k + 1] + bytes[k + 2] < %d;
    return n / (bytes.length / 4); })()"""


def shown(browser, canvas):
    return browser.evaluate(canvas + ".toDataURL()")


def choose(browser, element, value):
    browser.evaluate(f"(() => {{ const e = document.getElementById('{element}'); e.value = '{value}'; "
                     "e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); })()")


def look_at_view(browser, name):
    assert 0.05 < browser.evaluate(PAINTED % (SOLID, 560)) < 0.95, f"{name}: the view is empty or all dark"
    last, told = shown(browser, SOLID), browser.evaluate("document.getElementById('moment').textContent")
    choose(browser, "frame", 0)
    browser.wait(f"document.getElementById('moment').textContent !== {told!r}", 10)
    assert shown(browser, SOLID) != last, f"{name}: the slider changes nothing"
    choose(browser, "frame", browser.evaluate("document.getElementById('frame').max"))
    browser.wait(f"document.getElementById('moment').textContent === {told!r}", 10)
    assert shown(browser, SOLID) == last, f"{name}: the last frame is not what it was"
    choose(browser, "colour", "displacement")
    browser.wait(f"document.querySelector('.bar').textContent.startsWith('displacement')", 10)
    assert shown(browser, SOLID) != last, f"{name}: another colouring changes nothing"


def look_at_curves(browser, name):
    first = shown(browser, CURVE)
    assert 0.005 < browser.evaluate(PAINTED % (CURVE, 740)) < 0.5, f"{name}: the curve is empty"
    other = browser.evaluate("(() => { const e = document.getElementById('sensor-y'); return [...e.options].map(o => "
                             "o.value).find(v => v !== e.value && v !== 'stage' && v !== 'step'); })()")
    choose(browser, "sensor-y", other)
    second = shown(browser, CURVE)
    assert second != first, f"{name}: another sensor ({other}) changes nothing"
    x, y = browser.evaluate("(() => { const c = " + CURVE + "; c.scrollIntoView({block: 'center'}); const r = "
                            "c.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()")
    browser.wheel(x, y, -400)
    browser.wait(f"({CURVE}).toDataURL() !== {second!r}", 10)


def look_at(browser, page, first_view=None):
    name = os.path.basename(os.path.dirname(page))
    size = os.path.getsize(page)
    states = []
    for _ in range(1 if first_view is None else 3):
        browser.open(page)
        states.append(browser.wait("document.body.dataset.ready || document.body.dataset.failed ? "
                                   "{...document.body.dataset} : null"))
        assert "failed" not in states[-1], f"{name}: {states[-1]['failed']}"
    state = min(states, key=lambda one: int(one.get("first", 0)))
    print(f"{name}: {size / 1e6:.2f} MB, first view after {state.get('first')} ms, all after {state['ready']} ms")
    assert size <= SIZE, f"{name}: the page has {size / 1e6:.2f} MB; at most {SIZE / 1e6:.0f} are expected"
    folder = os.path.dirname(page)
    if os.path.exists(os.path.join(folder, "frames", "000000.vtkhdf")):
        assert first_view is None or int(state["first"]) <= first_view, f"{name}: first view after {state['first']} ms"
        look_at_view(browser, name)
    with open(os.path.join(folder, "histories.csv"), encoding="utf-8") as file:
        head, *rows = file
        sensors = len(head.split(",")) - 4 if rows else 0
    if sensors > 0:
        look_at_curves(browser, name)
    complaints = browser.complaints()
    assert not complaints, f"{name}: {complaints}"


def make_pages(folder, names):
    for name in names:
        out = os.path.join(folder, name)
        small.run(small.command(name, out, small.overrides(name)))
        small.run([small.PROGRAM, "report", out])
        yield os.path.join(out, "report.html")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--all", action="store_true", help="every example made small")
    parser.add_argument("--page", nargs="+", default=[], help="pages to look at")
    parser.add_argument("--picture", nargs=2, metavar=("FILE", "PAGE"))
    arguments = parser.parse_args()
    with Browser() as browser, tempfile.TemporaryDirectory() as folder:
        if arguments.picture:
            browser.open(arguments.picture[1])
            browser.wait("document.body.dataset.ready")
            browser.picture(arguments.picture[0], x=0, y=0, width=1225, height=1560, scale=0.62)
            return
        for page in arguments.page:
            look_at(browser, page, FIRST_VIEW)
        names = sorted(os.listdir(os.path.join(small.SOURCE, "examples"))) if arguments.all else EXAMPLES
        names = [name for name in names if os.path.exists(small.scene_of(name))]
        for page in [] if arguments.page else make_pages(folder, names):
            look_at(browser, page)


if __name__ == "__main__":
    main()
