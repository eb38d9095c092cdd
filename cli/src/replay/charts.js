"use strict";
// The charts, all on the clock of the views. With two runs the lines of the second are dashed.

/* From where to where a chart goes, and whether it cuts spikes off to do so: what lies twice as far out as nearly all. */
function spanOf(values) {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  if (!sorted.length) return { whole: [0, 1], usual: [0, 1], isCut: false };
  const [least, most] = [sorted[0], sorted[sorted.length - 1]];
  const [low, high] = [quantile(sorted, 0.01), quantile(sorted, 0.99)];
  const width = high - low;
  const usual = [least < low - 2 * width ? low - 0.3 * width : least, most > high + 2 * width ? high + 0.3 * width : most];
  const isCut = width > 0 && (usual[0] !== least || usual[1] !== most);
  const padded = ([from, to]) => {
    const room = (to - from) * 0.06 || Math.abs(to) * 0.1 || 1;
    return [from < 0 || from > 0.7 * to ? from - room : Math.min(0, from), to + room];
  };
  return { whole: padded([least, most]), usual: padded(isCut ? usual : [least, most]), isCut };
}

/* A number with three digits that matter. */
function short(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e5 || size < 1e-3)) return value.toExponential(1).replace("e+", "e");
  return String(Number(value.toPrecision(size >= 1000 ? 4 : 3)));
}

/* What is charted: a title, of each run the names and colours of its lines and how to get their values of a frame, and whether they are counts. */
const quantities = [
  ["Largest tension of each wire, N", run => run.names.wires.map((name, w) => [name, wireColour(run, w), frame => largest(frame.tensions[w], 0)])],
  ["Energy, J", run => {
    const potential = run.frames.find(frame => frame.energy)?.energy[1];
    const of = value => frame => frame.energy ? value(frame.energy) : null;
    return [
      ["kinetic", "#d6592b", of(([kinetic]) => kinetic)],
      ["elastic", "#2ca02c", of(([, , elastic]) => elastic)],
      ["potential since the first step", "#2f7fd0", of(([, height]) => height - potential)],
      ["sum of the three", "#8a949e", of(([kinetic, height, elastic]) => kinetic + height - potential + elastic)],
      ["work of scripted bodies and reels", "#9467bd", of(([, , , work]) => work)],
    ];
  }],
  ["Contacts", () => [["contacts", "#d6592b", frame => frame.contacts.length], ["pairs that met on the way", "#9467bd", frame => frame.met]], true],
  ["Angular speed, rad/s", run => run.header.bodies.map(({ dynamic }, k) => dynamic && [run.names.bodies[k], run.colours.bodies[k] ?? palette[k % palette.length], frame => frame.spin[k]]).filter(Boolean)],
];

function charts(times, seek) {
  if (times.length < 2) {
    byId("charts").append(Object.assign(document.createElement("p"), { className: "alone", textContent: "There is nothing to chart: no step was made." }));
    return [];
  }
  return quantities.map(([title, linesOf, isCount]) => {
    const lines = runs.flatMap((run, r) => linesOf(run).map(([name, shade, of]) => ({
      name: runs.length > 1 ? `${name}, ${run.how.split(",")[0] || r + 1}` : name,
      shade, isDashed: r > 0,
      values: times.map((_, k) => k < run.frames.length ? of(run.frames[k]) : null),
    })));
    return lines.length ? chart(title, times, lines, isCount, seek) : null;
  }).filter(Boolean);
}

/* The distances of marks where there are no fractions. */
const whole = Array.from({ length: 10 }, (_, power) => [1, 2, 5].map(digit => digit * 10 ** power)).flat();

function chart(title, times, lines, isCount, seek) {
  const box = Object.assign(document.createElement("div"), { className: "chart" });
  box.append(Object.assign(document.createElement("h2"), { textContent: title }));
  byId("charts").append(box);
  const span = spanOf(lines.flatMap(line => line.values));
  let isWhole = !span.isCut, at = 0;
  const axis = { stroke: colour("--pale"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: "11px system-ui", size: 30 };
  const values = document.createElement("div");
  values.className = "values";
  const cells = lines.map(line => {
    const cell = document.createElement("span"), dot = document.createElement("i"), number = document.createElement("b");
    dot.style.borderTop = `3px ${line.isDashed ? "dashed" : "solid"} ${line.shade}`;
    cell.append(dot, `${line.name} `, number);
    values.append(cell);
    return number;
  });
  const now = Object.assign(document.createElement("div"), { className: "now" });
  const place = plot => { now.style.left = `${plot.valToPos(times[at], "x")}px`; };
  const write = k => cells.forEach((cell, i) => { cell.textContent = short(lines[i].values[k] ?? NaN); });
  const plot = new lib.uPlot({
    width: 300, height: 140, padding: [10, 14, 0, 0], legend: { show: false },
    cursor: { sync: { key: "clock" }, drag: { x: false, y: false } },
    scales: { x: { time: false }, y: { range: () => isWhole ? span.whole : span.usual } },
    axes: [{ ...axis, values: (_, all) => all.map(value => `${short(value)} s`) }, { ...axis, size: 52, space: 24, values: (_, all) => all.map(short), ...(isCount ? { incrs: whole } : {}) }],
    series: [{}, ...lines.map(line => ({ label: line.name, stroke: line.shade, width: 1.5, dash: line.isDashed ? [5, 4] : [], points: { show: false } }))],
    hooks: { setCursor: [self => write(self.cursor.idx ?? at)], draw: [self => place(self)] },
  }, [times, ...lines.map(line => line.values)], box);
  box.append(values);
  if (span.isCut) {
    const button = Object.assign(document.createElement("button"), { type: "button", className: "cut" });
    const say = () => { button.textContent = isWhole ? "hide spikes" : "show spikes"; };
    button.addEventListener("click", () => { isWhole = !isWhole; say(); plot.setData(plot.data); });
    say();
    box.append(button);
  }
  plot.over.append(now);
  plot.over.addEventListener("click", event => seek(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x")));
  const fit = () => plot.setSize({ width: Math.max(240, box.clientWidth - 12), height: 140 });
  // Its box is narrower once there is so much that it is scrolled.
  new ResizeObserver(fit).observe(box);
  return {
    fit,
    show: k => { at = k; place(plot); write(plot.cursor.idx ?? k); },
  };
}
