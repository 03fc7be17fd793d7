// The panel: verdict, findings, layers, tables. Text goes in as text, never as markup.

function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === 'class') element.className = value;
    else if (name === 'on') for (const [event, act] of Object.entries(value)) element.addEventListener(event, act);
    else if (name in element && name !== 'list') element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.filter(child => child !== null && child !== undefined));
  return element;
}

const RANK = { error: 0, warning: 1, info: 2 };
const count = (number, what) => `${number} ${what}${number === 1 ? '' : 's'}`;
const mm = (length, decimals = 3) => `${length.toFixed(decimals)} mm`;

function duration(seconds) {
  const whole = Math.round(seconds), two = n => String(n).padStart(2, '0');
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return h ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

// What was found and what was warned of, the worst first, what lies beside the board behind what lies on it; each with its place in micrometres.
function collectItems(report, bounds) {
  const place = at => (at ? [at.x_mm * 1000, at.y_mm * 1000] : null);
  const cut = text => (text.length > 52 ? `${text.slice(0, 50)}…` : text);
  const short = ({ code, message, size_mm: size }) => cut(size ? `${code.replaceAll('-', ' ')}, ${size < 1 ? `${Math.round(size * 1000)} µm` : mm(size)}` : message);
  const findings = (report.verification?.findings ?? []).map(finding => ({
    ...finding, at: place(finding.at), short: short(finding), verified: true,
  }));
  const warnings = report.warnings.map(warning => ({
    ...warning, severity: 'warning', at: place(warning.at), short: cut(warning.message), nets: [],
  }));
  const items = [...findings, ...warnings];
  const off = at => (at ? Number(beside(bounds, ...at).some(way => way > 0)) : 2);
  const order = item => RANK[item.severity] * 6 + (item.verified ? 0 : 3) + off(item.at);
  items.sort((a, b) => order(a) - order(b));
  items.forEach((item, index) => { item.index = index; });
  return items;
}

// The verdict in a word and a sentence.
function verdict(report) {
  const { verification, warnings } = report;
  const warned = verification ? verification.warnings + warnings.length : warnings.length;
  if (!verification) {
    return { level: warned ? 'warning' : 'info', word: 'Not verified', text: warned ? count(warned, 'warning') : 'The programs were not verified.' };
  }
  if (verification.errors) return { level: 'error', word: 'Do not mill yet', text: `${count(verification.errors, 'error')}, ${count(warned, 'warning')}` };
  if (warned) return { level: 'warning', word: 'Look before you mill', text: `no error, ${count(warned, 'warning')}` };
  return { level: 'good', word: 'Verified', text: 'Simulated and compared with the design: nothing found.' };
}

class Panel {
  constructor(element, report, stage, player, actions) {
    Object.assign(this, { element, report, stage, player, actions });
    this.rows = new Map();
    this.boxes = new Map();
    element.append(
      this.verdict(), this.findings(), this.layers(), this.programs(), this.drills(), this.nets(), this.milled(), this.how(), this.about(),
    );
  }

  section(title, ...children) {
    const id = `s-${title.toLowerCase().replaceAll(' ', '-')}`;
    return make('section', { 'aria-labelledby': id }, make('h2', { id }, title), ...children);
  }

  verdict() {
    const { level, word, text } = verdict(this.report);
    const first = this.stage.items.find(item => item.at);
    const judged = this.report.verification?.judged ?? [];
    const pixels = judged.map(entry => entry.pixel_mm).filter(Boolean);
    const how = pixels.length ? `Verified from the text of the programs, on pixels of ${Math.round(Math.max(...pixels) * 1000)} µm; depths from exact geometry.` : null;
    return make('section', { class: `verdict ${level}`, id: 'verdict' },
      make('strong', {}, word), make('p', {}, text), how ? make('p', { class: 'how' }, how) : null,
      first ? make('button', { class: 'show', id: 'show-first', on: { click: () => this.actions.select(first) } }, level === 'error' ? 'Show me the first error' : 'Show me') : null);
  }

  findings() {
    const { items } = this.stage;
    if (!items.length) return this.section('Findings', make('p', { class: 'none' }, 'Nothing was found and nothing is to be warned of.'));
    const groups = new Map();
    for (const item of items) {
      const key = `${item.severity} ${item.code}`;
      if (groups.has(key)) groups.get(key).push(item); else groups.set(key, [item]);
    }
    const list = [...groups.values()].map((group, index) => this.group(group, index === 0 || group[0].severity === 'error'));
    return this.section('Findings', make('p', { class: 'hint' }, 'Press n and p to go from one to the next.'), ...list);
  }

  group(items, open) {
    const [{ severity, code }] = items;
    const list = make('ol', {});
    const more = (from, to) => items.slice(from, to).forEach(item => list.append(this.row(item)));
    const MOST = 40;
    more(0, MOST);
    const rest = items.length > MOST ? make('button', { class: 'more', on: { click: event => { more(MOST); event.target.remove(); } } }, `${items.length - MOST} more`) : null;
    return make('details', { open, class: `group ${severity}` },
      make('summary', {}, make('span', { class: `mark ${severity}` }), make('b', {}, code.replaceAll('-', ' ')), make('span', { class: 'count' }, String(items.length))), list, rest);
  }

  row(item) {
    const where = [item.side, item.at ? `${(item.at[0] / 1000).toFixed(2)}, ${(item.at[1] / 1000).toFixed(2)} mm` : null,
      item.program ? `${item.program}${item.line ? `:${item.line}` : ''}` : null,
      item.source ? `${item.source.file}:${item.source.line}` : null].filter(Boolean).join(' · ');
    const text = [make('span', { class: 'message' }, item.message), make('span', { class: 'where' }, where)];
    const row = item.at || item.line
      ? make('button', { class: 'item', title: 'Show me', 'data-item': item.index, on: { click: () => this.actions.select(item) } }, ...text)
      : make('div', { class: 'item still' }, ...text);
    this.rows.set(item, row);
    return make('li', {}, row);
  }

  layers() {
    const box = layer => {
      const input = make('input', { type: 'checkbox', checked: layer.on, id: `layer-${layer.id}`, on: { change: event => this.actions.layer(layer.id, event.target.checked) } });
      this.boxes.set(layer.id, input);
      const key = LAYERS.indexOf(layer) < 9 ? make('kbd', {}, String(LAYERS.indexOf(layer) + 1)) : null;
      return make('label', { class: 'layer' }, input, make('i', { class: `swatch ${layer.swatch}` }), layer.name, key);
    };
    const scale = make('div', { class: 'scale', id: 'scale', hidden: true }, make('p', {}, 'How far the edge of a cut is from copper:'),
      ...CLEARANCE.map(stop => make('span', {}, make('i', { style: `background:${stop.colour}` }), stop.text)));
    return this.section('Layers', make('div', { class: 'layers' }, ...LAYERS.map(box)), scale);
  }

  table(head, rows, foot) {
    const cells = (tag, row) => make('tr', {}, ...row.map((cell, i) => make(tag, i ? { class: 'number' } : tag === 'th' ? { scope: 'col' } : {}, cell)));
    return make('div', { class: 'wide' }, make('table', {}, make('thead', {}, cells('th', head)), make('tbody', {}, ...rows.map(row => cells('td', row))),
      foot ? make('tfoot', {}, cells('td', foot)) : null));
  }

  programs() {
    const { programs, total, tool_changes: changes } = this.report;
    const waits = changes.count ? [[`${changes.count} tool ${changes.count > 1 ? 'changes' : 'change'}`, '', '', '', duration(changes.seconds)]] : [];
    const row = (name, f) => [name, f.cut_mm.toFixed(0), f.rapid_mm.toFixed(0), String(f.retracts), duration(f.seconds)];
    const play = (program, index) => make('button', { class: 'link', title: 'Play from its start', on: { click: () => this.actions.run(index) } }, program.file);
    const tools = this.stage.programs.flatMap(program => program.tools.map(tool => [`${tool.name}`, program.part, tool.cut_mm.toFixed(0), duration(tool.seconds)]));
    return this.section('Programs',
      this.table(['Program', 'Cut mm', 'Rapid mm', 'Retracts', 'Time'], [...programs.map((program, i) => row(play(program, i), program)), ...waits], row('Total', total)),
      make('h3', {}, 'Tools'), this.table(['Tool', 'For', 'Cut mm', 'Time'], tools));
  }

  drills() {
    if (!this.report.drills.length) return null;
    const rows = this.report.drills.map(drill => [mm(drill.diameter_mm), String(drill.holes), String(drill.slots)]);
    return this.section('Drills', this.table(['Diameter', 'Holes', 'Slots'], rows));
  }

  nets() {
    const lists = this.stage.sides.map(side => {
      const row = net => make('button', { class: 'net', on: { click: () => this.actions.net(side, net), pointerenter: () => this.actions.hint(side, net), pointerleave: () => this.actions.hint(side, null) } }, net.name, make('span', {}, String(net.features)));
      return make('details', {}, make('summary', {}, make('b', {}, side.side), make('span', { class: 'count' }, String(side.nets.length))), make('div', { class: 'nets' }, ...side.nets.map(row)));
    });
    const gaps = this.report.layers.filter(layer => layer.smallest_gap).map(({ side, smallest_gap: gap }) => make('p', {}, `Smallest gap on the ${side}: `,
      make('button', { class: 'link', on: { click: () => this.actions.place(side, gap.at.x_mm * 1000, gap.at.y_mm * 1000) } }, `${mm(gap.width_mm)} between ${gap.between.join(' and ')}`)));
    return this.section('Nets', ...gaps, ...lists, ...this.coupling());
  }

  // The nets that lie closest to each other for longest.
  coupling() {
    const layers = this.report.layers.filter(layer => layer.coupling?.pairs.length);
    return layers.map(({ side, coupling }) => {
      const rows = coupling.pairs.map(({ between, boundary_mm: length, length_over_gap: over, capacitance_pf: farads }) =>
        [between.join(' and '), length.toFixed(1), over.voronoi.toFixed(0), farads.voronoi.toFixed(2), farads.as_drawn.toFixed(2)]);
      const { voronoi, as_drawn: drawn } = coupling.capacitance_pf;
      return make('details', {}, make('summary', {}, make('b', {}, `Coupling, ${side}`), make('span', { class: 'count' }, `${voronoi.toFixed(1)} pF`)),
        make('p', { class: 'how' }, `An estimate: coplanar strips ${mm(coupling.kerf_mm)} apart on ${coupling.thickness_mm} mm of permittivity ${coupling.permittivity}. In all ${voronoi.toFixed(1)} pF; as drawn, without the copper beside it, ${drawn.toFixed(1)} pF.`),
        this.table(['Nets', 'mm', 'Length/gap', 'pF', 'as drawn'], rows));
    });
  }

  // Pictures of sides, drawn when they are unfolded.
  unfolded(title, id, sides, pictures) {
    if (!sides.length) return null;
    const unfold = ({ target }, side) => { if (target.open && !target.querySelector('canvas')) target.append(...pictures(side)); };
    const fold = side => make('details', { id: `${id}-${side.side}`, on: { toggle: event => unfold(event, side) } }, make('summary', {}, make('b', {}, side.side)));
    return this.section(title, ...sides.map(fold));
  }

  // The board as it comes from the mill.
  milled() {
    const sides = this.stage.sides.filter(side => this.stage.programs.some(program => program.side === side.side));
    return this.unfolded('As milled', 'milled', sides, side => [asMilled(this.stage, side, 1000 * parseFloat(this.report.settings.thickness)),
      make('p', { class: 'how' }, `What the programs leave of the copper, three times as deep as it is${side.side === 'back' ? '; mirrored, as it lies on the mill' : ''}.`)]);
  }

  // How the cuts are found.
  how() {
    return this.unfolded('How it was found', 'how', this.stage.sides.filter(side => side.nets.length > 1), side => howFound(side, this.stage.drawing.bounds));
  }

  about() {
    const { report } = this, settings = Object.entries(report.settings).map(([key, value]) => [key, value]);
    const files = report.sources.map(source => [source.file, source.role ?? '']);
    return this.section('About',
      make('details', {}, make('summary', {}, make('b', {}, 'Settings'), make('span', { class: 'count' }, String(settings.length))), this.table(['Setting', 'Value'], settings)),
      make('details', {}, make('summary', {}, make('b', {}, 'Files'), make('span', { class: 'count' }, String(files.length))), this.table(['File', 'Role'], files)),
      make('p', { class: 'how' }, `Made by ${report.generator}. Both sides are seen from the front unless the back is shown from below.`));
  }

  // Marks the row of what is shown.
  mark(item) {
    for (const [other, row] of this.rows) {
      if (other === item) row.setAttribute('aria-current', 'true'); else row.removeAttribute('aria-current');
    }
    const row = this.rows.get(item);
    if (!row) return;
    row.closest('details').open = true;
    // The panel scrolls, not the page.
    const [box, at] = [this.element.getBoundingClientRect(), row.getBoundingClientRect()];
    if (at.top < box.top || at.bottom > box.bottom) this.element.scrollTop += at.top - box.top - 60;
  }
}
