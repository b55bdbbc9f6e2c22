// A run in a notebook, drawn as on the page of `closeranks view`: liars are squares, who is short of neighbours has a broken ring, colours
// are values from dark blue over grey to yellow. Python sends all frames at once (`_view.py`); here they are only shown.

const [INK, LINK, LIAR, SHORT] = ["#1a1a1a", "#9aa7b3", "#d55e00", "#a3005c"];
const STOPS = [[0, 45, 108], [58, 79, 122], [124, 123, 120], [187, 170, 100], [254, 226, 70]];
const [WIDTH, HEIGHT, MARGIN] = [560, 420, 36];

/** The colour of a value between `low` and `high`, and the ink that can be read on it. */
export function colour(value, [low, high]) {
  if (!Number.isFinite(value)) return ["#ffffff", INK];
  const fraction = high > low ? Math.min(1, Math.max(0, (value - low) / (high - low))) : 0.5;
  const place = fraction * (STOPS.length - 1);
  const index = Math.min(Math.floor(place), STOPS.length - 2);
  const mixed = STOPS[index].map((part, axis) => Math.round(part + (place - index) * (STOPS[index + 1][axis] - part)));
  return [`rgb(${mixed.join(",")})`, fraction < 0.6 ? "#ffffff" : INK];
}

/** The frames of a run as numbers: four a robot, which are x and y (m), value and degree. */
export function unpack(bytes, robots) {
  const view = bytes instanceof DataView ? bytes : new DataView(bytes);
  const at = (frame, robot, column) => view.getFloat32(4 * (4 * (frame * robots + robot) + column), true);
  const frames = view.byteLength / (16 * robots);
  const robot = (frame, index) => ({ x: at(frame, index, 0), y: at(frame, index, 1), value: at(frame, index, 2), degree: at(frame, index, 3) });
  return { frames, moment: (frame) => Array.from({ length: robots }, (_, index) => robot(frame, index)) };
}

/** The place on the canvas of each robot, px, and how many px are a metre: the whole team fits. */
export function placed(moment) {
  const [xs, ys] = [moment.map(({ x }) => x), moment.map(({ y }) => y)];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min((WIDTH - 2 * MARGIN) / Math.max(right - left, 1), (HEIGHT - 2 * MARGIN) / Math.max(high - low, 1));
  const place = ({ x, y }) => [WIDTH / 2 + (x - (left + right) / 2) * scale, HEIGHT / 2 - (y - (low + high) / 2) * scale];
  return { points: moment.map(place), scale };
}

function links(context, moment, points, { radius_m, team_of }) {
  context.beginPath();
  moment.forEach((one, index) => {
    moment.slice(0, index).forEach((other, before) => {
      if (team_of[index] !== team_of[before] || Math.hypot(one.x - other.x, one.y - other.y) > radius_m) return;
      context.moveTo(...points[index]);
      context.lineTo(...points[before]);
    });
  });
  context.strokeStyle = LINK;
  context.lineWidth = 1;
  context.globalAlpha = moment.length > 20 ? 0.25 : 0.6;
  context.stroke();
  context.globalAlpha = 1;
}

function ring(context, [x, y], size) {
  context.beginPath();
  context.arc(x, y, size + 4, 0, 2 * Math.PI);
  context.setLineDash([5, 3]);
  context.strokeStyle = SHORT;
  context.lineWidth = 2.5;
  context.stroke();
  context.setLineDash([]);
}

function body(context, robot, number, [x, y], size, team) {
  const [liar, [fill, ink]] = [team.malicious.includes(number), colour(robot.value, team.values)];
  context.beginPath();
  if (liar) context.rect(x - size, y - size, 2 * size, 2 * size);
  else context.arc(x, y, size, 0, 2 * Math.PI);
  context.fillStyle = fill;
  context.fill();
  context.lineWidth = liar ? 4 : 2;
  context.strokeStyle = liar ? LIAR : "#ffffff";
  context.stroke();
  if (!liar && robot.degree < team.required_degrees[number - 1]) ring(context, [x, y], size);
  context.fillStyle = ink;
  context.font = `600 ${Math.round(0.85 * size)}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(String(number), x, y + 0.5);
}

function draw(context, moment, team) {
  const { points, scale } = placed(moment);
  const size = Math.max(7, Math.min(15, 0.22 * scale, 120 / Math.sqrt(moment.length)));
  context.clearRect(0, 0, WIDTH, HEIGHT);
  links(context, moment, points, team);
  moment.forEach((robot, index) => body(context, robot, index + 1, points[index], size, team));
}

/** What a moment comes to, in a sentence: for who does not see the picture, and for everybody below it. */
export function said(moment, team, time_s) {
  const all = moment.map((robot, index) => ({ ...robot, needed: team.required_degrees[index] }));
  const normal = all.filter((_, index) => !team.malicious.includes(index + 1));
  const spare = ({ degree, needed }) => degree - needed;
  const least = normal.reduce((one, other) => (spare(other) < spare(one) ? other : one));
  const values = normal.map(({ value }) => value).filter(Number.isFinite);
  const spread = values.length > 0 ? Math.max(...values) - Math.min(...values) : NaN;
  return `${time_s.toFixed(2)} s: least degree ${least.degree} of ${least.needed} needed, values ${spread.toPrecision(3)} apart`;
}

/** The element `name` with `fields`, holding `inside`. */
function element(name, fields, ...inside) {
  const made = Object.assign(document.createElement(name), fields);
  made.append(...inside);
  return made;
}

/** Calls `turn` with seconds since the last call, as long as it is playing. */
function clock(turn) {
  let last = null;
  const tick = (now) => {
    const goesOn = turn(last === null ? 0 : (now - last) / 1000);
    last = now;
    if (goesOn) requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

function render({ model, el }) {
  const team = model.get("team");
  const ticks = model.get("ticks");
  const { frames, moment } = unpack(model.get("numbers"), team.robots);
  const time_s = (frame) => ticks[frame] * team.tick_s;
  const canvas = element("canvas", { width: WIDTH, height: HEIGHT });
  canvas.setAttribute("role", "img");
  const play = element("button", { type: "button" }, "Play");
  const slider = element("input", { type: "range", min: 0, max: frames - 1, step: 1 });
  slider.setAttribute("aria-label", "Time");
  const words = element("output", {});
  el.append(element("div", {}, canvas, element("div", {}, play, slider), words));

  const set = (name, value) => {
    model.set(name, value);
    model.save_changes();
  };
  const show = () => {
    const frame = model.get("frame");
    draw(canvas.getContext("2d"), moment(frame), team);
    slider.value = String(frame);
    words.textContent = said(moment(frame), team, time_s(frame));
    canvas.setAttribute("aria-label", `${team.name}, ${words.textContent}`);
  };
  let now_s = 0;
  const turn = (elapsed_s) => {
    if (!model.get("playing") || !el.isConnected) return false;
    now_s += elapsed_s;
    let frame = model.get("frame");
    while (frame + 1 < frames && time_s(frame + 1) <= now_s) frame += 1;
    if (frame !== model.get("frame")) set("frame", frame);
    if (frame + 1 === frames) set("playing", false);
    return model.get("playing");
  };
  const playing = () => {
    play.textContent = model.get("playing") ? "Pause" : "Play";
    if (!model.get("playing")) return;
    now_s = time_s(model.get("frame"));
    clock(turn);
  };
  play.addEventListener("click", () => {
    if (!model.get("playing") && model.get("frame") + 1 === frames) set("frame", 0);
    set("playing", !model.get("playing"));
  });
  slider.addEventListener("input", () => {
    set("playing", false);
    set("frame", Number(slider.value));
  });
  model.on("change:frame", show);
  model.on("change:playing", playing);
  show();
  playing();
  return () => {
    model.off("change:frame", show);
    model.off("change:playing", playing);
  };
}

export default { render };
