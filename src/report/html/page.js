// The page: puts the parts together and listens.

const { report, drawing } = JSON.parse(document.getElementById('data').textContent);
const $ = id => document.getElementById(id);

applyTheme();
const sides = drawing.sides.map((side, index) => new BoardSide(side, report.layers[index]));
const programs = drawing.programs.map(program => new Program(program));
const items = collectItems(report, drawing.bounds);
const stage = new Stage($('stage'), drawing, sides, programs, items);
const player = stage.player = new Player(stage);

const actions = {
  // Shows a finding: its side, its place, its row, and the motion that caused it.
  select(item) {
    stage.selected = item;
    if (!stage.on.findings) actions.layer('findings', true);
    panel.mark(item);
    $('live').textContent = item.message;
    const program = programs.find(one => one.file === item.program);
    const n = program && item.line ? program.way.line.findIndex(line => line >= item.line) : -1;
    if (item.at) actions.place(item.side, ...item.at);
    else if (n > 0) actions.place(item.side ?? program.side, program.way.x[n], program.way.y[n]);
    else stage.point();
  },
  place(side, x, y) {
    if (side && stage.mode !== 'both' && stage.mode !== side) showSide(side);
    stage.go(stage.around(x, y));
  },
  layer(id, on) {
    stage.on[id] = on;
    panel.boxes.get(id).checked = on;
    $('scale').hidden = !stage.on.heat;
    stage.update();
  },
  run(index) { player.seek(player.starts[index]); player.play(true); },
  net(side, net) {
    const boxes = net.paths.map(path => path.box);
    const edge = (i, pick) => boxes.map(box => box[i]).reduce((a, b) => pick(a, b));
    const [left, bottom, right, top] = [edge(0, Math.min), edge(1, Math.min), edge(2, Math.max), edge(3, Math.max)];
    if (stage.mode !== 'both') showSide(side.side);
    const pane = stage.panes[0];
    const scale = Math.min(pane.width / (right - left + 4000), pane.height / (top - bottom + 4000));
    stage.go({ x: (left + right) / 2, y: (bottom + top) / 2, scale });
    actions.hint(side, net);
  },
  hint(side, net) {
    const pane = stage.panes.find(one => one.side === side);
    stage.hover = pane && net ? { pane, net, x: 0, y: 0 } : null;
    stage.point();
  },
};

const panel = new Panel($('panel'), report, stage, player, actions);

function showSide(mode) {
  stage.show(mode);
  for (const button of document.querySelectorAll('[data-side]')) button.setAttribute('aria-pressed', String(button.dataset.side === mode));
}

function header() {
  const size = report.size_mm ? `${report.size_mm[0].toFixed(1)} × ${report.size_mm[1].toFixed(1)} mm` : '';
  $('size').textContent = [size, count(report.layers.reduce((sum, layer) => sum + layer.nets.length, 0), 'net'), duration(report.total.seconds)].filter(Boolean).join(' · ');
  const { level, word } = verdict(report);
  $('pill').textContent = word;
  $('pill').className = `pill ${level}`;
  const modes = sides.length > 1 ? [...sides.map(side => side.side), 'both'] : sides.map(side => side.side);
  $('sides').append(...modes.map(mode => make('button', { 'data-side': mode, title: 'Side (f)', on: { click: () => showSide(mode) } }, mode)));
  $('behind').hidden = !sides.some(side => side.side === 'back');
  $('behind').onclick = () => { stage.behind = !stage.behind; $('behind').setAttribute('aria-pressed', String(stage.behind)); stage.update(); };
  $('theme').onclick = turnTheme;
  $('help').onclick = () => $('keys').showModal();
  $('fit').onclick = () => stage.fit();
  $('closer').onclick = () => stage.zoom(1.6);
  $('farther').onclick = () => stage.zoom(1 / 1.6);
}

function turnTheme() {
  applyTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
  stage.update();
}

// What lies under the pointer.
function look(pane, px, py) {
  const [x, y] = pane.toBoard(px, py), reach = 7 / stage.view.scale;
  const net = stage.on.milled ? undefined : pane.side.netAt(x, y);
  const edge = net ? null : pane.side.edgeAt(x, y, reach);
  let motion = null;
  for (const program of pane.programs) {
    const shown = program.side ? stage.on.cuts || stage.on.milled : program.part === 'drill' ? stage.on.drills : stage.on.cutout;
    const found = shown ? program.motionAt(x, y, reach) : null;
    if (found && found.off < (motion?.off ?? Infinity)) motion = { ...found, program };
  }
  stage.hover = { pane, x, y, net, edge, motion };
  readout();
  stage.point();
}

function readout() {
  const lines = [], { hover } = stage;
  if (hover && hover.x !== undefined) {
    const { net, edge, motion, x, y } = hover;
    if (net) lines.push(['net', net.name]);
    if (edge) {
      const room = hover.pane.side.room(edge.clearance);
      lines.push(['between', edge.owners.join(' and ')]);
      lines.push(['clearance', `${(edge.clearance / 1000).toFixed(3)} mm, ${room < 0 ? `the cut removes ${(-room / 1000).toFixed(3)} mm of copper` : `${(room / 1000).toFixed(3)} mm to spare`}`]);
    }
    if (motion) {
      const { program, n } = motion;
      lines.push(['program', `${program.file}:${program.way.line[n]}`]);
      lines.push(['cut', `${(program.kerf(n) / 1000).toFixed(3)} mm wide, ${(-Math.min(program.way.z[n], program.way.z[n - 1]) / 1000).toFixed(3)} mm deep`]);
    }
    lines.push(['at', `${(x / 1000).toFixed(3)}, ${(y / 1000).toFixed(3)} mm`]);
  }
  $('readout').replaceChildren(...lines.map(([what, text]) => make('div', {}, make('b', {}, what), text)));
  $('readout').hidden = !lines.length;
}

// Dragging, pinching, the wheel.
function pointers() {
  const down = new Map();
  let dragged = 0;
  const paneAt = event => stage.panes.find(pane => pane.element.contains(event.target)) ?? stage.panes[0];
  const local = (event, pane) => { const box = pane.element.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  const box = $('stage');
  box.addEventListener('pointerdown', event => {
    if (event.button) return;
    down.set(event.pointerId, event);
    dragged = 0;
    box.setPointerCapture(event.pointerId);
    box.focus({ preventScroll: true });
  });
  box.addEventListener('pointermove', event => {
    const pane = stage.panes.find(one => { const r = one.element.getBoundingClientRect(); return event.clientX >= r.left && event.clientX < r.right; }) ?? paneAt(event);
    const before = down.get(event.pointerId);
    if (!before) return look(pane, ...local(event, pane));
    const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
    dragged += Math.abs(dx) + Math.abs(dy);
    if (down.size === 2) {
      const [a, b] = [...down.values()], other = a.pointerId === event.pointerId ? b : a;
      const span = one => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY) || 1;
      stage.zoom(span(event) / span(before), ...local(event, pane), pane);
      stage.pan(dx / 2, dy / 2, pane);
    } else {
      stage.pan(dx, dy, pane);
    }
    down.set(event.pointerId, event);
  });
  const up = event => {
    const pressed = down.delete(event.pointerId);
    if (!pressed || dragged > 4 || event.type === 'pointercancel') return;
    const pane = stage.panes.find(one => { const r = one.element.getBoundingClientRect(); return event.clientX >= r.left && event.clientX < r.right; });
    if (pane && stage.on.findings) {
      const [x, y] = local(event, pane);
      const spot = pane.clusters().find(one => Math.hypot(one.x - x, one.y - y) < 16);
      if (spot) { actions.select(spot.items[(spot.items.indexOf(stage.selected) + 1) % spot.items.length]); return; }
    }
    if (stage.hover?.motion) player.seekTo(stage.hover.motion.program, stage.hover.motion.n);
  };
  box.addEventListener('pointerup', up);
  box.addEventListener('pointercancel', up);
  box.addEventListener('pointerleave', () => { stage.hover = null; readout(); stage.point(); });
  box.addEventListener('wheel', event => {
    event.preventDefault();
    const pane = paneAt(event), lines = event.deltaMode ? 30 : 1;
    stage.zoom(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0016)), ...local(event, pane), pane);
  }, { passive: false });
  box.addEventListener('dblclick', event => { const pane = paneAt(event); stage.zoom(2, ...local(event, pane), pane); });
}

function nextFinding(way) {
  const shown = items.filter(item => item.at || item.line);
  if (!shown.length) return;
  const at = shown.indexOf(stage.selected);
  actions.select(shown[(at + way + shown.length + (at < 0 && way < 0 ? 1 : 0)) % shown.length]);
}

function keys() {
  const KEYS = {
    ArrowLeft: () => stage.pan(80, 0), ArrowRight: () => stage.pan(-80, 0), ArrowUp: () => stage.pan(0, 80), ArrowDown: () => stage.pan(0, -80),
    '+': () => stage.zoom(1.4), '=': () => stage.zoom(1.4), '-': () => stage.zoom(1 / 1.4), 0: () => stage.fit(), Home: () => stage.fit(),
    n: () => nextFinding(1), p: () => nextFinding(-1), ' ': () => player.play(), t: turnTheme, '?': () => $('keys').showModal(),
    ',': () => player.seek(player.now - 5), '.': () => player.seek(player.now + 5), m: () => $('behind').click(),
    f: () => { const modes = [...document.querySelectorAll('[data-side]')].map(button => button.dataset.side); showSide(modes[(modes.indexOf(stage.mode) + 1) % modes.length]); },
  };
  addEventListener('keydown', event => {
    const typing = event.target.matches('input, select, textarea');
    const presses = event.target.matches('button, summary') && (event.key === ' ' || event.key === 'Enter');
    if (typing || presses || event.ctrlKey || event.metaKey || event.altKey || $('keys').open) return;
    const layer = LAYERS[+event.key - 1];
    const act = KEYS[event.key] ?? (layer && (() => actions.layer(layer.id, !stage.on[layer.id])));
    if (!act) return;
    event.preventDefault();
    act();
  });
}

function transport() {
  const bar = $('time');
  bar.max = player.total;
  bar.step = 'any';
  $('play').onclick = () => player.play();
  $('speed').onchange = event => { player.speed = +event.target.value; };
  $('follow').onchange = () => player.changed();
  bar.oninput = () => player.seek(+bar.value);
  $('parts').append(...programs.map((program, i) => make('button', { style: `flex-grow:${Math.max(program.seconds, player.total / 30)}`, title: `${program.file}, ${duration(program.seconds)}`, on: { click: () => player.seek(player.starts[i] + 0.01) } }, program.part)));
  let index = player.index;
  player.changed = () => {
    bar.value = player.now;
    $('play').textContent = player.playing ? '❚❚' : '▶';
    $('play').setAttribute('aria-label', player.playing ? 'Pause' : 'Play the programs');
    const tool = player.tool();
    $('clock').textContent = `${duration(player.now)} / ${duration(player.total)}`;
    $('line').textContent = tool ? `${tool.program.file}:${tool.line}` : player.now >= player.total ? 'all done' : 'at the start';
    bar.setAttribute('aria-valuetext', `${$('clock').textContent}, ${$('line').textContent}`);
    [...$('parts').children].forEach((part, i) => part.classList.toggle('now', Boolean(tool) && i === player.index));
    if (tool && player.index !== index && tool.program.side && stage.mode !== 'both') showSide(tool.program.side);
    index = player.index;
    if (tool && $('follow').checked) { stage.view = { ...stage.view, x: tool.x, y: tool.y }; stage.moved(); }
  };
  player.changed();
}

function printing() {
  let kept = '', folded = [];
  addEventListener('beforeprint', () => {
    kept = themeName;
    // Nothing can be unfolded on paper.
    folded = [...document.querySelectorAll('.group:not([open])')];
    folded.forEach(group => { group.open = true; });
    applyTheme('light');
    stage.panes.forEach(pane => { pane.render(); pane.drawOver(); });
  });
  addEventListener('afterprint', () => {
    folded.forEach(group => { group.open = false; });
    applyTheme(kept);
    stage.update();
  });
}

header();
pointers();
keys();
transport();
printing();
prefersDark.addEventListener('change', () => { applyTheme(); stage.update(); });
showSide((items.find(item => item.at && item.side)?.side ?? sides[0]?.side) || 'front');
const worst = items.find(item => item.at);
if (worst) { stage.selected = worst; panel.mark(worst); }
document.documentElement.dataset.ready = 'true';
