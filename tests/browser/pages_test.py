"""The report and the league's page in a real browser: pages_test.py LIECHECK LEAGUE_PAGE FOLDER [AXE].

With AXE, the file axe.min.js of the npm package axe-core, only the accessibility of both pages is checked.

The page of the report is made here, from the record of a small campaign. What it unpacks is compared with report.json.
"""

import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import webdriver

LIECHECK, LEAGUE, FOLDER = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
AXE = pathlib.Path(sys.argv[4]).read_text() if len(sys.argv) > 4 else ""
WIDTHS = (360, 420, 1400)
PACKED = json.loads((pathlib.Path(__file__).parent.parent / "reports/packed.json").read_text())  # Packed.IsWhatTheScriptRestores

# Words whose letters stand on two lines. A line may end after a space, a hyphen or a slash.
BROKEN_WORDS = r"""
const broken = [], texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), range = document.createRange();
for (let text; (text = texts.nextNode());) {
  if (text.parentElement.closest("code, script, style, noscript, option") || !text.parentElement.checkVisibility()) continue;
  for (const word of text.data.matchAll(/[^\s\-–—−\/…,:|×()]+/g)) {
    range.setStart(text, word.index);
    range.setEnd(text, word.index + word[0].length);
    const lines = new Set([...range.getClientRects()].filter(r => r.width > 0).map(r => Math.round(r.top)));
    if (lines.size > 1) broken.push(word[0]);
  }
}
return broken;"""

# What is wider than the page, with everything unfolded.
OVERFLOW = r"""
const wide = document.documentElement.scrollWidth - innerWidth;
return wide <= 0 ? [] : [`${wide} px`, ...[...document.querySelectorAll("body *")].filter(e =>
  e.getBoundingClientRect().right > innerWidth + 1 && !e.closest(".scroll")).slice(0, 5).map(e => e.outerHTML.slice(0, 99))];"""

UNFOLD = "for (const d of document.querySelectorAll('section > details')) d.open = true;"

# The pixels of each visible canvas that have the colour, or nearly.
PIXELS = r"""
const [red, green, blue] = arguments[0].match(/\w\w/g).map(h => parseInt(h, 16));
return [...document.querySelectorAll("canvas")].filter(c => c.checkVisibility()).map(c => {
  const copy = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
  Object.assign(copy.canvas, {width: c.width, height: c.height});
  copy.drawImage(c, 0, 0);
  const {data} = copy.getImageData(0, 0, c.width, c.height);
  let n = 0;
  for (let i = 0; i < data.length; i += 4)
    n += data[i + 3] > 200 && Math.abs(data[i] - red) + Math.abs(data[i + 1] - green) + Math.abs(data[i + 2] - blue) < 12;
  return n;
});"""


def liecheck(*words, code=0):
    done = subprocess.run([LIECHECK, *map(str, words)], cwd=FOLDER, capture_output=True, text=True, timeout=120)
    if done.returncode != code:
        raise RuntimeError(f"liecheck {words} ended with {done.returncode}: {done.stdout[-999:]}{done.stderr[-999:]}")


def make_report():
    """A campaign on a right and a wrong library, with times, in FOLDER/out."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    laws = [word for law in ("exp_oracle", "log_oracle", "jacobian_oracle") for word in ("--property", law)]
    liecheck("campaign", "--subject", "liecheck", "--subject", "textbook", *laws, "--cases", 150, "--json", "record.json", code=1)
    liecheck("cost", "--op", "exp6", "--subject", "liecheck", "--subject", "textbook", "--for", 1, "--json", "cost.json")
    record = json.loads((FOLDER / "record.json").read_text())
    record["cost"] = json.loads((FOLDER / "cost.json").read_text())
    (FOLDER / "record.json").write_text(json.dumps(record))
    liecheck("report", "record.json", "--out", "out")
    page = (FOLDER / "out/report.html").read_text()
    at = page.rindex("</script>")  # the last script is the module, whose names no other script can see
    (FOLDER / "out/seen.html").write_text(page[:at] + "globalThis.unpackedNumbers = numbers; globalThis.unpacks = unpacked;\n"
                                           "globalThis.hardLines = () => hardCases().flatMap(c => [...c.columns.values()].flat().map(cell => cell.replay)).sort();\n" + page[at:])
    return json.loads((FOLDER / "out/report.json").read_text())


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.report = make_report()
        cls.browser = webdriver.Browser()
        cls.addClassCleanup(cls.browser.close)

    def show(self, fragment="", width=1400, scheme="light", page=None, script=True):
        self.browser.devtools("Emulation.setScriptExecutionDisabled", value=not script)
        self.browser.media(scheme=scheme)
        self.browser.size(width)
        self.browser.open(page or FOLDER / "out/report.html", fragment)
        if not page and script:
            self.run_until("return document.documentElement.dataset.filled === 'yes'")

    def run_until(self, script):
        promise = f"const is = () => {{ {script} }}; const end = Date.now() + 5000; return new Promise(done => {{ const look = () =>" \
                  " is() || Date.now() > end ? done(is()) : setTimeout(look, 20); look(); });"
        self.assertTrue(self.browser.run(promise), script)

    def tearDown(self):
        if self.browser.session:
            self.assertEqual(self.browser.errors(), [])

    def choose(self, name, value):
        self.browser.run("const e = document.querySelector('#controls').elements[arguments[0]]; e.value = arguments[1];"
                         "e.dispatchEvent(new Event('change', {bubbles: true}));", name, value)

    def cells(self):
        """Each visible cell of the table of digits: operation, subject, scalar, and the number of its visible boxes."""
        return self.browser.run("return [...document.querySelectorAll('button.digits')].filter(b => b.checkVisibility()).map(b => [b.dataset.operation,"
                                "b.dataset.subject, b.dataset.scalar, [...b.querySelectorAll('i')].filter(i => i.checkVisibility()).length])")

    def open_cell(self, operation, subject, scalar="double"):
        self.browser.press(f"button.digits[data-operation='{operation}'][data-subject='{subject}'][data-scalar='{scalar}']", "\ue007")  # the Enter key

    def test_unpacks_the_figures_of_the_record(self):
        self.show(page=FOLDER / "out/seen.html")
        self.run_until("return globalThis.unpackedNumbers !== undefined")
        seen = self.browser.run("return unpackedNumbers")
        self.assertEqual(self.browser.run("return unpacks(arguments[0])", PACKED["packed"]), PACKED["plain"])
        self.assertEqual(self.browser.run("return hardLines()"), sorted(cell["replay"] for hard in self.report["records"][0]["hard_cases"]
                                                                        for cell in hard["cells"]))
        self.assertEqual(len(seen["results"]), len(self.report["results"]))
        for shown, stored in zip(seen["results"], self.report["results"]):
            for name in ("subject", "scalar", "operation", "block", "band", "low", "high", "count", "budget", "status", "failed"):
                self.assertEqual(shown[name], stored[name])
            for name in ("max_eps", "p99_eps", "median_eps"):  # the page has four digits
                if isinstance(stored[name], str):
                    self.assertEqual(shown[name], stored[name])
                else:
                    self.assertAlmostEqual(shown[name], stored[name], delta=1e-3 * stored[name])

    def test_pictures_have_the_lines_of_each_library(self):
        lines = "return [...document.querySelectorAll('#cover svg, #price svg')].map(svg => [...svg.querySelectorAll('.line, .mark')]" \
                ".map(e => [getComputedStyle(e).stroke, e.getBoundingClientRect().width]))"
        colours = {"light": ["rgb(0, 114, 178)", "rgb(213, 94, 0)"], "dark": ["rgb(90, 180, 236)", "rgb(255, 138, 61)"]}
        for scheme, libraries in colours.items():
            for script in (True, False):
                self.show(scheme=scheme, script=script)
                pictures = self.browser.run(lines)
                self.assertEqual(len(pictures), 3, "near 0, near pi, and the price of a digit")
                for picture in pictures:
                    self.assertEqual(sorted({colour for colour, _ in picture}), sorted(libraries))
                for picture in pictures[:2]:
                    for library in libraries:
                        self.assertGreater(max(width for colour, width in picture if colour == library), 100)

    def test_charts_have_the_lines_of_each_library(self):
        for scheme, colours in (("light", {"liecheck": "0072b2", "textbook": "d55e00"}), ("dark", {"liecheck": "5ab4ec", "textbook": "ff8a3d"})):
            self.show(scheme=scheme)
            self.open_cell("exp6", "textbook")
            self.run_until("return document.querySelectorAll('#digits canvas').length > 0")
            self.run_until(f"const count = c => {{ {PIXELS.replace('arguments[0]', 'c')} }}; return Math.min(...count('{colours['textbook']}')) > 200")
            self.open_cell("exp6", "textbook")
            self.assertEqual(self.browser.run("return document.querySelectorAll('#digits canvas').length"), 0)
            self.browser.run("document.querySelector('#cost > details').open = true; document.querySelector('#cost .cost-charts').scrollIntoView();")
            self.run_until("return document.querySelectorAll('#cost canvas').length > 0")
            for colour in colours.values():
                self.run_until(f"const count = c => {{ {PIXELS.replace('arguments[0]', 'c')} }}; return Math.max(...count('{colour}')) > 20")

    def test_every_place_has_the_same_hard_cases(self):
        """The verdicts, the answer, the campaign, the map, the table of verdicts and the matrix that a script writes."""
        self.show()
        self.browser.run(UNFOLD)
        says = {row["subject"]: [] for row in self.report["results"]}
        texts = self.browser.run("return [...document.querySelectorAll('#sentences li')].map(l => [l.querySelector('b').textContent, l.textContent])")
        for subject, text in texts:
            says[subject].append(self.counted(text))
        rows = self.browser.run("return [...document.querySelectorAll('#stability .dense tbody tr')].map(r => [...r.cells].map(c => c.textContent))")
        for subject in says:
            own = [row for row in rows if row[0].startswith(subject + " in ")]
            says[subject].append((sum(int(row[-1]) for row in own), sum(int(row[1]) for row in own)))
        titles = self.browser.run("return [...document.querySelectorAll('#stability-matrix tr.class td[aria-label]')].map(c => c.getAttribute('aria-label'))")
        for subject in says:
            own = [re.search(r": (\d+) of (\d+) failed", t).groups() for t in titles if f", {subject} in " in t]
            says[subject].append((sum(int(a) for a, _ in own), sum(int(b) for _, b in own)))
        for subject, all_ in says.items():
            self.assertEqual(len(all_), 3)
            self.assertEqual(len(set(all_)), 1, (subject, all_))
        total = tuple(map(sum, zip(*(all_[0] for all_ in says.values()))))
        self.assertGreater(total[0], 0)
        for place in ("#hard p", "#standings .summary"):
            self.assertEqual(self.counted(self.browser.run(f"return document.querySelector('{place}').textContent")), total, place)
        classes = self.browser.run("return [...document.querySelectorAll('#hard g > title')].map(t => t.textContent)")
        rest = self.browser.run("return [...document.querySelectorAll('#hard text')].map(t => t.textContent).filter(t => /further classes/.test(t)).join('')")
        sums = [re.search(r": (\d+) of (\d+) (cases )?fail", t).groups() for t in [*classes, *([rest] if rest else [])]]
        self.assertEqual((sum(int(s[0]) for s in sums), sum(int(s[1]) for s in sums)), total)

    @staticmethod
    def counted(text):
        """(failing, all) of "41 of 585 hard cases fail" or "none of 585 hard cases fails"."""
        found = re.search(r"(none|\d+) of (\d+) hard cases fail", text)
        return (0 if found[1] == "none" else int(found[1]), int(found[2]))

    def test_every_place_has_the_same_digits(self):
        """The boxes that are written with the page say what the rows of an opened cell say, which scripts write."""
        self.show()
        for operation, subject, scalar in (("exp6", "textbook", "double"), ("log6", "textbook", "float"), ("exp6", "liecheck", "double")):
            self.open_cell(operation, subject, scalar)
            boxes, kept = self.browser.run("const d = document.querySelector('#digits-table tr.detail'); return [[...document.querySelectorAll("
                                           "'button[aria-expanded=true].digits i')].map(i => i.textContent).filter(t => t !== '·'),"
                                           "[...d.querySelectorAll('tr[data-region]')].map(r => [...r.cells].map(c => c.textContent))]")
            self.assertEqual(len(boxes), len(kept))
            for box, row in zip(boxes, kept):
                if box not in "NB":
                    self.assertEqual(int(box), math.floor(float(row[1]) + .05 + 1e-9), (operation, subject, scalar, row))

    def test_filters_filter(self):
        self.show()
        every = self.cells()
        self.assertEqual({(o, s, t) for o, s, t, _ in every}, {(r["operation"], r["subject"], r["scalar"]) for r in self.report["results"] if r["count"]})
        self.choose("operation", "log6")
        both = [("log6", "liecheck"), ("log6", "textbook")]
        self.assertEqual(sorted({(o, s) for o, s, _, _ in self.cells()}), both)
        self.assertEqual(len(self.cells()), 4, "each in float and double")
        self.choose("region", "pi")
        self.assertEqual([n for _, _, _, n in self.cells()], [1, 1, 1, 1])
        self.choose("region", "")
        self.choose("operation", "")
        self.choose("scalar", "float")
        self.assertEqual({t for _, _, t, _ in self.cells()}, {"float"})
        self.browser.run("document.querySelector('[name=subject][value=textbook]').click()")
        self.assertEqual({s for _, s, _, _ in self.cells()}, {"liecheck"})

    def test_a_cell_opens_the_worst_case_of_the_record(self):
        self.show()
        self.open_cell("exp6", "textbook")
        ids, lines = self.browser.run("const d = document.querySelector('#digits-table tr.detail'); return [[...d.querySelectorAll('code.replay')]"
                                      ".map(c => c.textContent), [...d.querySelectorAll('.worst tr')].map(r => [...r.cells].map(c => c.textContent))]")
        self.assertEqual(len(ids), 1)
        own = [r for r in self.report["results"] if (r["subject"], r["scalar"], r["operation"]) == ("textbook", "double", "exp6") and r["worst"]]
        worst = max(own, key=lambda r: (r["status"] == "fail", r["not_finite"] > 0, r["max_eps"] if r["rule"] == "forward" else r["max_excess"]))
        self.assertEqual(ids[0], "liecheck replay " + worst["worst"]["id"])
        inputs = [line for line in lines if len(line) == 3 and line[2].lstrip("-").startswith("0x")]
        self.assertEqual([line[2] for line in inputs], worst["worst"]["input"])
        for _, decimal, hexadecimal in inputs:
            self.assertEqual(float(decimal), float.fromhex(hexadecimal))
        results = [line for line in lines if len(line) == 5 and line[3].lstrip("-").startswith("0x")]
        self.assertEqual([[line[0], line[3], line[4]] for line in results],
                         [[n["name"], n["got"], n["expected"]] for n in worst["worst"].get("numbers", [])])
        for _, got, expected, got_hexadecimal, expected_hexadecimal in results:
            self.assertEqual([float(got), float(expected)], [float.fromhex(got_hexadecimal), float.fromhex(expected_hexadecimal)])

    def test_the_replay_line_copies(self):
        self.show()
        self.open_cell("exp6", "textbook")
        self.browser.devtools("Browser.grantPermissions", permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
        line = self.browser.run("document.querySelector('#digits button.copy').click(); return document.querySelector('#digits code.replay').textContent")
        self.run_until("return document.querySelector('#digits button.copy').textContent === 'copied'")
        self.assertEqual(self.browser.run("return navigator.clipboard.readText()"), line)

    def test_a_choice_survives_a_reload(self):
        state = "return [location.hash, document.querySelector('#digits-table').innerText," \
                "...[...document.querySelectorAll('#controls select')].map(s => s.value)," \
                "...[...document.querySelectorAll('[name=subject]')].map(s => s.checked)]"
        self.show()
        unchosen = self.browser.run(state)
        self.choose("scalar", "float")
        self.choose("operation", "log6")
        self.choose("region", "pi")
        self.browser.run("document.querySelector('[name=subject][value=liecheck]').click()")
        self.open_cell("log6", "textbook", "float")
        before = self.browser.run(state)
        for i, part in enumerate(unchosen[:5]):
            self.assertNotEqual(before[i], part)
        self.assertIn("liecheck replay", before[1])
        self.show(before[0])
        self.assertEqual(self.browser.run(state), before)

    def test_each_section_has_a_heading_with_a_link_that_unfolds_it(self):
        self.show()
        links = self.browser.run("return [...document.querySelectorAll('main section[id]')].filter(s => s.querySelector('h2'))"
                                 ".map(s => [s.id, s.querySelector('a.anchor')?.getAttribute('href')])")
        self.assertGreater(len(links), 8)
        for name, link in links:
            self.assertEqual(link, "#" + name)
        self.show("#coverage")
        self.assertTrue(self.browser.run("return document.querySelector('#coverage > details').open"))
        self.browser.run("document.querySelector('#hard a[href=\"#stability\"]').click()")
        self.assertTrue(self.browser.run("return document.querySelector('#stability > details').open"))
        self.assertIn("at=stability", self.browser.run("return location.hash"))

    def test_answers_are_on_the_first_screen(self):
        self.show()
        self.assertLessEqual(self.browser.run("return document.querySelector('#answers').getBoundingClientRect().bottom"), 900)
        self.show(width=390, script=False)
        self.assertLessEqual(self.browser.run("return document.querySelector('#cover h2').getBoundingClientRect().bottom"), 844)

    def test_dark_and_print_have_styles_of_their_own(self):
        colours = "const s = getComputedStyle(document.body); return [s.backgroundColor, s.color].map(c => c.match(/\\d+/g).slice(0, 3)" \
                  ".reduce((n, x) => n + +x, 0) / 765)"
        self.show()
        paper, ink = self.browser.run(colours)
        self.assertGreater(paper - ink, .7)
        self.browser.media(scheme="dark")
        paper, ink = self.browser.run(colours)
        self.assertGreater(ink - paper, .7)
        hidden = "return [...document.querySelectorAll('#controls, .copy, section:has(> details:not([open]))')].filter(e => e.checkVisibility()).length"
        self.assertGreater(self.browser.run(hidden), 0)
        self.browser.media("print", "dark")
        self.assertEqual(self.browser.run(hidden), 0)
        self.assertGreater(self.browser.run(colours)[0], .95, "paper is white")
        self.browser.media()
        pages = len(re.findall(rb"/Type\s*/Page\b", self.browser.printed()))
        self.assertIn(pages, range(1, 7))

    def test_nothing_overflows_and_no_word_is_broken(self):
        for width in WIDTHS:
            self.show(width=width)
            self.browser.run(UNFOLD)
            self.open_cell("exp6", "textbook")
            self.assertEqual(self.browser.run(OVERFLOW), [], width)
            self.assertEqual(self.browser.run(BROKEN_WORDS), [], width)

    def test_the_league(self):
        for width in WIDTHS:
            self.show(width=width, page=LEAGUE)
            self.assertEqual(self.browser.run(OVERFLOW), [], width)
        ranking = "return document.querySelector('#ranking').innerText"
        first = self.browser.run(ranking)
        self.assertIn("eigen", first)
        self.browser.run("document.querySelectorAll('#questions button')[1].click()")
        self.assertNotEqual(self.browser.run(ranking), first)
        self.browser.run("document.querySelector('#matrix td button').click()")
        self.assertIn("cases", self.browser.run("return document.querySelector('#detail').innerText"))

    @unittest.skipUnless(AXE, "axe-core is one of the packages of the league")
    def test_accessibility(self):
        for page in (None, LEAGUE):
            for scheme in ("light", "dark"):
                for width in (420, 1400):
                    self.show(width=width, scheme=scheme, page=page)
                    self.browser.run(UNFOLD)
                    self.browser.run(AXE + "; globalThis.axe = axe;")
                    if not page:
                        self.open_cell("exp6", "textbook")
                    found = self.browser.run("return axe.run().then(r => r.violations.map(v => [v.id, v.help, v.nodes[0].html]))")
                    self.assertEqual(found, [], (page, scheme, width))


if __name__ == "__main__":
    unittest.main(argv=[*sys.argv[:1], *(["Pages.test_accessibility"] if AXE else [])], verbosity=2)
