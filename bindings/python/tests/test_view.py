"""A run that plays in a notebook: what is sent, and what a real browser makes of it."""

from __future__ import annotations

import base64
import html
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import traitlets

import closeranks as cr
from closeranks import _view

PAGE = """<!doctype html><meta charset="utf-8"><div id="here"></div><pre id="told"></pre>
<script type="module">
const state = {{ team: {team}, ticks: {ticks}, frame: 0, playing: false }};
state.numbers = new DataView(Uint8Array.from(atob("{numbers}"), (letter) => letter.charCodeAt(0)).buffer);
const listeners = {{}};
let now = 0;
window.requestAnimationFrame = (call) => setTimeout(() => call((now += 16)), 0);
const model = {{
  get: (name) => state[name],
  set: (name, value) => {{ state[name] = value; for (const call of listeners["change:" + name] ?? []) call(); }},
  save_changes: () => {{}},
  on: (name, call) => {{ (listeners[name] ??= []).push(call); }},
  off: (name, call) => {{ listeners[name] = listeners[name].filter((other) => other !== call); }},
}};
const lines = [];
try {{
  const view = await import("data:text/javascript;base64,{module}");
  const el = document.getElementById("here");
  const leave = view.default.render({{ model, el }});
  const [canvas, button, slider, words] = ["canvas", "button", "input", "output"].map((name) => el.querySelector(name));
  const seen = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  const pixels = (rgb) => {{
    let count = 0;
    for (let at = 0; at < seen.length; at += 4) count += rgb.every((part, axis) => part === seen[at + axis]) ? 1 : 0;
    return count;
  }};
  lines.push(words.textContent, "liars " + (pixels([0xd5, 0x5e, 0x00]) > 100), "max " + slider.max);
  slider.value = "2";
  slider.dispatchEvent(new Event("input"));
  lines.push("frame " + state.frame, words.textContent);
  button.click();
  lines.push("button " + button.textContent, "playing " + state.playing);
  const over = () => {{
    if (state.playing) return setTimeout(over, 1);
    lines.push("frame " + state.frame, "button " + button.textContent, words.textContent);
    button.click();
    lines.push("again from " + state.frame);
    leave();
    lines.push("listeners " + Object.values(listeners).flat().length);
    document.getElementById("told").textContent = lines.join("\\n");
  }};
  over();
}} catch (error) {{
  document.getElementById("told").textContent = String(error);
}}
</script>"""


@pytest.fixture(scope="module")
def short() -> cr.Run:
    """A second with two liars."""
    return cr.Scenario.paper("nominal").replace(duration_s=1.0).run(progress=False)


def words(run: cr.Run, tick: int) -> str:
    """What the widget says of a tick, written once more."""
    normal = ~run.scenario.is_malicious
    values, degree = run.values[tick, normal].astype(np.float32), run.degree[tick, normal].min()
    spread = float(values.max()) - float(values.min())
    told = f"{spread:#.3g}".removesuffix(".")
    return f"{tick * run.scenario.tick_s:.2f} s: least degree {degree} of {run.scenario.required_degree} needed, values {told} apart"


def test_what_is_sent_is_the_run(short: cr.Run) -> None:
    view = short.view(frames=5)
    assert isinstance(view, _view.RunView) and view.ticks == [0, 50, 100, 150, 200]
    sent = np.frombuffer(view.numbers, dtype="<f4").reshape(5, 11, 4)
    assert np.array_equal(sent[:, :, :2], short.positions[view.ticks].astype(np.float32))
    assert np.array_equal(sent[:, :, 2], short.values[view.ticks].astype(np.float32))
    assert np.array_equal(sent[:, :, 3], short.degree[view.ticks])
    assert view.team["malicious"] == [1, 2] and view.team["required_degrees"] == [7] * 11 and view.team["team_of"] == [0] * 11
    view.frame = 4
    assert view.get_state(["frame", "playing"]) == {"frame": 4, "playing": False}
    with pytest.raises(traitlets.TraitError, match="frame is 5, allowed is 0 to 4"):
        view.frame = 5
    with pytest.raises(cr.Error, match="frames is 0, allowed is 1 to 2000"):
        short.view(frames=0)


def test_a_run_in_space_and_a_run_of_few_ticks_are_shown() -> None:
    space = cr.Scenario(dimension=3, duration_s=0.05).run(progress=False)
    view = space.view()
    assert view.ticks == list(range(len(space.h)))
    sent = np.frombuffer(view.numbers, dtype="<f4").reshape(-1, 11, 4)
    assert np.array_equal(sent[-1, :, :2], space.positions[-1, :, :2].astype(np.float32))


def test_a_browser_shows_and_plays_it(short: cr.Run, tmp_path: Path) -> None:
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("there is no chromium")
    view = short.view(frames=5)
    script = (Path(_view.__file__).parent / "view.js").read_bytes()
    numbers, module = (base64.b64encode(each).decode() for each in (view.numbers, script))
    page = tmp_path / "page.html"
    team = str(view.team).replace("'", '"')
    page.write_text(PAGE.format(team=team, ticks=view.ticks, numbers=numbers, module=module))
    flags = ["--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}"]
    command = [chromium, *flags, "--virtual-time-budget=20000", "--dump-dom", page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    found = re.search(r'<pre id="told">(.*?)</pre>', done.stdout, re.DOTALL)
    assert found is not None, done.stdout
    assert html.unescape(found[1]).splitlines() == [
        *[words(short, 0), "liars true", "max 4"],
        *["frame 2", words(short, 100)],
        *["button Pause", "playing true"],
        *["frame 4", "button Play", words(short, 200)],
        *["again from 0", "listeners 0"],
    ]
