// The stage: one or two panes over the same view. In each, three canvases lie on each other: `base` the board, `work` what
// the machine does to it, `over` what points at something. Base and work are drawn when the view rests; while it moves, the browser moves
// their pixels.

const LAYERS = [
  { id: 'board', name: 'Board', on: true, swatch: 'rim' },
  { id: 'copper', name: 'Copper', on: true, swatch: 'copper' },
  { id: 'nets', name: 'A colour for each net', on: false, swatch: 'nets' },
  { id: 'names', name: 'Net names', on: true, swatch: 'ink' },
  { id: 'regions', name: 'Voronoi regions', on: true, swatch: 'regions' },
  { id: 'lines', name: 'Voronoi boundaries', on: false, swatch: 'tool' },
  { id: 'cuts', name: 'Isolation cuts', on: true, swatch: 'cut' },
  { id: 'heat', name: 'Clearance of the cuts (heat)', on: false, swatch: 'heat' },
  { id: 'lost', name: 'Copper that cuts remove', on: true, swatch: 'lost' },
  { id: 'rapids', name: 'Rapids', on: false, swatch: 'rapid' },
  { id: 'drills', name: 'Drills', on: true, swatch: 'hole' },
  { id: 'drillPath', name: 'Drill path', on: false, swatch: 'path' },
  { id: 'cutout', name: 'Cutout', on: true, swatch: 'rim' },
  { id: 'milled', name: 'Milled simulation', on: false, swatch: 'clad' },
  { id: 'findings', name: 'Findings', on: true, swatch: 'error' },
];

// How far a place is beside a box, across and up.
function beside([left, bottom, right, top], x, y) {
  return [Math.max(left - x, 0, x - right), Math.max(bottom - y, 0, y - top)];
}

class Pane {
  constructor(stage, side) {
    this.stage = stage;
    this.side = side;
    this.element = document.createElement('div');
    this.element.className = 'pane';
    const tag = document.createElement('span');
    tag.className = 'tag';
    tag.textContent = side.side;
    [this.base, this.work, this.over] = ['base', 'work', 'over'].map(name => {
      const canvas = document.createElement('canvas');
      canvas.className = name;
      this.element.append(canvas);
      return canvas.getContext('2d', { alpha: true });
    });
    this.element.append(tag);
    this.drawn = null;
  }

  get programs() {
    return this.stage.programs.filter(program => !program.side || program.side === this.side.side);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    Object.assign(this, { width, height, ratio: Math.min(2, devicePixelRatio || 1) });
    for (const { canvas } of [this.base, this.work, this.over]) {
      canvas.width = Math.max(1, Math.round(width * this.ratio));
      canvas.height = Math.max(1, Math.round(height * this.ratio));
    }
    this.drawn = null;
  }

  get flip() { return this.stage.behind && this.side.side === 'back' ? -1 : 1; }

  toScreen(x, y) {
    const { view } = this.stage;
    return [this.width / 2 + this.flip * (x - view.x) * view.scale, this.height / 2 - (y - view.y) * view.scale];
  }

  toBoard(px, py) {
    const { view } = this.stage;
    return [view.x + this.flip * (px - this.width / 2) / view.scale, view.y - (py - this.height / 2) / view.scale];
  }

  // A context cleared and in board coordinates, and the part of the board that it shows.
  begin(context) {
    const { view } = this.stage, s = view.scale * this.ratio;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.globalAlpha = 1;
    context.clearRect(0, 0, context.canvas.width, context.canvas.height);
    context.setTransform(this.flip * s, 0, 0, -s, (this.width / 2) * this.ratio - this.flip * view.x * s, (this.height / 2) * this.ratio + view.y * s);
    context.lineCap = context.lineJoin = 'round';
    const [ax, ay] = this.toBoard(0, 0), [bx, by] = this.toBoard(this.width, this.height);
    return [Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by)];
  }

  get pixel() { return 1 / this.stage.view.scale; }

  // Base and work anew.
  render() {
    this.drawBase();
    this.drawWork();
    this.drawn = { ...this.stage.view };
    for (const { canvas } of [this.base, this.work]) canvas.style.transform = '';
  }

  // The pixels of the last rendering, moved to where they belong now.
  shift() {
    if (!this.drawn) return;
    const { view } = this.stage, scale = view.scale / this.drawn.scale;
    const tx = this.flip * view.scale * (this.drawn.x - view.x), ty = view.scale * (view.y - this.drawn.y);
    for (const { canvas } of [this.base, this.work]) canvas.style.transform = `translate(${tx}px, ${ty}px) scale(${scale})`;
  }

  drawBase() {
    const { on, drawing } = this.stage, context = this.base, seen = this.begin(context);
    const outline = this.stage.outline;
    if (outline && (on.board || on.milled)) {
      context.fillStyle = on.milled ? theme.clad : theme.board;
      context.fill(outline, 'evenodd');
    } else if (on.milled) {
      const [left, bottom, right, top] = drawing.bounds;
      context.fillStyle = theme.clad;
      context.fillRect(left - 2000, bottom - 2000, right - left + 4000, top - bottom + 4000);
    }
    if (on.milled) return;
    if (on.regions) {
      context.save();
      if (outline) context.clip(outline, 'evenodd');
      this.side.regions.forEach((path, net) => {
        context.fillStyle = theme.tint(this.side.hues[net]);
        context.fill(path, 'evenodd');
      });
      context.restore();
    }
    if (on.copper || on.nets) this.drawCopper(context, seen, net => (on.nets ? theme.vivid((net.id * 137.5) % 360) : theme.copper), undefined, 0.35);
    if (on.board && outline) {
      context.strokeStyle = theme.rim;
      context.lineWidth = 1.25 * this.pixel;
      context.stroke(outline);
    }
  }

  // `bleed` closes the seams of planes that are hatched with strokes which just touch.
  drawCopper(context, seen, colour, nets = this.side.nets, bleed = 0) {
    for (const net of nets) {
      context.fillStyle = context.strokeStyle = colour(net);
      for (const { width, box, path } of net.paths) {
        if (!meets(box, seen)) continue;
        if (!width) { context.fill(path); continue; }
        context.lineWidth = Math.max(width, this.pixel * 0.75) + bleed * this.pixel;
        context.stroke(path);
      }
    }
  }

  // What the machine has done up to now.
  drawWork() {
    const { on, player } = this.stage, context = this.work, seen = this.begin(context);
    if (on.drills) this.drawHoles(context);
    for (const program of this.programs) {
      const done = player.done(program);
      const isolates = program.side !== null;
      const drills = program.part === 'drill';
      if (isolates && (on.cuts || on.milled)) this.drawRuns(context, seen, program, 0, done, on.milled ? theme.board : theme.cut, !on.milled);
      if (drills && on.drills) this.drawRuns(context, seen, program, 0, done, theme.hole, false);
      if (!isolates && !drills && on.cutout) {
        // Each pass a little more: what is left at the tabs stays lighter.
        context.globalAlpha = 0.16;
        this.drawRuns(context, seen, program, 0, done, theme.rim, false);
        context.globalAlpha = 1;
      }
      if (isolates ? on.rapids : drills && on.drillPath) this.drawRapids(context, program, drills ? theme.path : theme.rapid);
      if (!isolates && !drills && on.rapids) this.drawRapids(context, program, theme.rapid);
    }
    // Over the cuts, which follow them.
    if (on.lines && !on.milled) {
      context.strokeStyle = theme.tool;
      context.lineWidth = 1.25 * this.pixel;
      context.stroke(this.side.lines);
    }
    if (on.heat) {
      context.lineWidth = Math.max(3 * this.pixel, (this.side.kerfs[0]?.[1] ?? 0) * 0.5);
      this.side.heat.forEach((path, stop) => {
        context.strokeStyle = CLEARANCE[stop].colour;
        context.stroke(path);
      });
    }
    if (on.lost && !on.milled && !player.playing) this.drawLost(context, seen);
    if ((on.board || on.milled) && on.drills) this.drawRims(context);
  }

  // The holes as designed; drilling fills them.
  drawHoles(context) {
    const drilled = this.stage.programs.some(program => program.part === 'drill');
    for (const [diameter, , path] of this.stage.holes) {
      context.lineWidth = Math.max(diameter, this.pixel);
      context.strokeStyle = drilled ? theme.rim : theme.hole;
      context.globalAlpha = drilled ? 0.55 : 1;
      context.stroke(path);
    }
    context.globalAlpha = 1;
  }

  drawRims(context) {
    const { outline } = this.stage;
    if (!outline || !this.stage.on.cutout) return;
    context.strokeStyle = theme.rim;
    context.lineWidth = 1.25 * this.pixel;
    context.stroke(outline);
  }

  // The cuts of a program from a number of motions to another; those to come as a thin line where `hints`.
  drawRuns(context, seen, program, from, { n, fraction }, colour, hints) {
    const alpha = context.globalAlpha;
    context.strokeStyle = colour;
    for (const run of program.runs) {
      if (!meets(run.box, seen) || run.last <= from) continue;
      context.lineWidth = Math.max(run.width, this.pixel);
      if (run.last < n || (run.last === n && fraction >= 1)) {
        context.stroke(run.first > from ? run.path : program.trace(from + 1, run.last));
        continue;
      }
      const first = Math.max(run.first, from + 1);
      if (first <= n) context.stroke(program.trace(first, n, fraction));
      if (hints) {
        context.globalAlpha = alpha * 0.35;
        context.lineWidth = this.pixel;
        context.stroke(run.path);
        context.globalAlpha = alpha;
      }
    }
  }

  // What was cut since, over what is drawn already.
  drawMore(program, from, done) {
    const { on } = this.stage, isolates = program.side !== null;
    if (isolates ? !(on.cuts || on.milled) : !on.drills) return;
    const colour = isolates ? (on.milled ? theme.board : theme.cut) : theme.hole;
    this.drawRuns(this.work, [-Infinity, -Infinity, Infinity, Infinity], program, from, done, colour, false);
  }

  drawRapids(context, program, colour) {
    context.strokeStyle = colour;
    context.lineWidth = 1.25 * this.pixel;
    context.setLineDash([5 * this.pixel, 4 * this.pixel]);
    context.stroke(program.rapids);
    context.setLineDash([]);
  }

  // Where cuts and copper meet: both drawn aside, and one kept within the other.
  drawLost(context, seen) {
    const cutting = this.programs.filter(program => program.side);
    if (!cutting.length) return;
    const [copper, cuts] = this.stage.scratch(context.canvas.width, context.canvas.height);
    this.begin(copper);
    this.drawCopper(copper, seen, () => theme.lost);
    this.begin(cuts);
    for (const program of cutting) this.drawRuns(cuts, seen, program, 0, this.stage.player.done(program), '#000', false);
    for (const each of [copper, cuts]) each.setTransform(1, 0, 0, 1, 0, 0);
    copper.globalCompositeOperation = 'destination-in';
    copper.drawImage(cuts.canvas, 0, 0);
    copper.globalCompositeOperation = 'source-over';
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(copper.canvas, 0, 0);
    context.restore();
  }

  // What points at something: names, the net under the pointer, findings, the tool, a scale.
  drawOver() {
    const { on, hover, player } = this.stage, context = this.over;
    const seen = this.begin(context);
    if (hover?.pane === this && hover.net && !on.milled) {
      context.globalAlpha = 0.35;
      this.drawCopper(context, seen, () => theme.glow, [hover.net]);
      context.globalAlpha = 1;
    }
    if (hover?.motion && hover.pane === this) {
      const { program, n } = hover.motion;
      context.strokeStyle = theme.tool;
      context.lineWidth = Math.max(program.kerf(n), 3 * this.pixel);
      context.stroke(program.trace(n, n));
    }
    const tool = player.tool();
    if (tool && (!tool.program.side || tool.program.side === this.side.side)) this.drawTool(context, tool);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    if (on.names && (on.copper || on.nets)) this.drawNames(context, seen);
    if (hover && hover.pane !== this) this.drawCross(context, ...this.toScreen(hover.x, hover.y));
    if (on.findings) this.drawFindings(context);
    this.drawScale(context);
  }

  drawTool(context, { program, n, x, y, z }) {
    const width = Math.max(program.kerf(n), 10 * this.pixel);
    context.beginPath();
    context.arc(x, y, width / 2, 0, 2 * Math.PI);
    context.lineWidth = 2 * this.pixel;
    context.strokeStyle = theme.tool;
    if (z < 0) { context.fillStyle = theme.tool; context.globalAlpha = 0.45; context.fill(); context.globalAlpha = 1; }
    else context.setLineDash([3 * this.pixel, 3 * this.pixel]);
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + dx * (width / 2 + 3 * this.pixel), y + dy * (width / 2 + 3 * this.pixel));
      context.lineTo(x + dx * (width / 2 + 11 * this.pixel), y + dy * (width / 2 + 11 * this.pixel));
    }
    context.stroke();
  }

  drawCross(context, x, y) {
    context.strokeStyle = theme.tool;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x - 9, y); context.lineTo(x + 9, y);
    context.moveTo(x, y - 9); context.lineTo(x, y + 9);
    context.stroke();
  }

  // The names that have room: those that files give, and numbers when they are looked at closely.
  drawNames(context, seen) {
    const { scale } = this.stage.view;
    context.font = '600 11px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    const taken = [];
    for (const { name, named, label: [x, y, width] } of this.side.nets) {
      if (x < seen[0] || x > seen[2] || y < seen[1] || y > seen[3] || width * scale < (named ? 24 : 60)) continue;
      const room = context.measureText(name).width + 8;
      if (room > width * scale * 1.6) continue;
      const [px, py] = this.toScreen(x, y);
      const plate = [px - room / 2, py - 8, px + room / 2, py + 8];
      if (taken.some(other => meets(other, plate))) continue;
      taken.push(plate);
      context.fillStyle = theme.plate;
      context.beginPath();
      context.roundRect(px - room / 2, py - 8, room, 16, 4);
      context.fill();
      context.fillStyle = theme.ink;
      context.fillText(name, px, py + 0.5);
    }
  }

  // Findings that fall together are one mark with their number; the worst gives its colour and shape.
  clusters() {
    const spots = [];
    for (const item of this.stage.items) {
      if (!item.at || (item.side && item.side !== this.side.side)) continue;
      const [x, y] = this.toScreen(...item.at);
      if (x < -20 || y < -20 || x > this.width + 20 || y > this.height + 20) continue;
      const near = spots.find(spot => Math.abs(spot.x - x) < 18 && Math.abs(spot.y - y) < 18);
      if (near) near.items.push(item); else spots.push({ x, y, items: [item] });
      if (spots.length > 400) break;
    }
    return spots;
  }

  drawFindings(context) {
    const { selected } = this.stage, spots = this.clusters();
    const few = spots.length <= 12;
    for (const { x, y, items } of [...spots].reverse()) {
      const worst = items[0], chosen = items.includes(selected);
      const size = chosen ? 15 : worst.severity === 'error' ? 12 : 9;
      drawMark(context, x, y, size, worst.severity, chosen);
      if (items.length > 1) {
        context.font = '700 10px system-ui, sans-serif';
        context.textAlign = 'center';
        context.textBaseline = 'bottom';
        outlined(context, String(items.length), x, y - size - 2, theme[worst.severity]);
      }
      if (chosen || (few && worst.severity === 'error')) this.drawCaption(context, x, y, size, chosen ? selected : worst);
    }
  }

  drawCaption(context, x, y, size, item) {
    context.font = '600 12px system-ui, sans-serif';
    context.textBaseline = 'middle';
    context.textAlign = 'left';
    const room = context.measureText(item.short).width + 14;
    const left = Math.max(4, x + size + 8 + room > this.width ? x - size - 8 - room : x + size + 8);
    context.fillStyle = theme.plate;
    context.strokeStyle = theme[item.severity];
    context.lineWidth = 1.5;
    context.beginPath();
    context.roundRect(left, y - 11, room, 22, 6);
    context.fill();
    context.stroke();
    context.fillStyle = theme.ink;
    context.fillText(item.short, left + 7, y + 0.5);
  }

  drawScale(context) {
    const { scale } = this.stage.view, most = this.width / 5 / scale;
    const length = [50000, 20000, 10000, 5000, 2000, 1000, 500, 200, 100, 50, 20, 10, 5, 2, 1].find(um => um <= most) ?? 1;
    const text = length >= 1000 ? `${length / 1000} mm` : `${length} µm`;
    const right = this.width - 16, y = this.height - 16;
    const bar = new Path2D();
    bar.moveTo(right - length * scale, y - 4);
    bar.lineTo(right - length * scale, y);
    bar.lineTo(right, y);
    bar.lineTo(right, y - 4);
    for (const [width, colour] of [[4.5, theme.plate], [1.5, theme.ink]]) {
      Object.assign(context, { lineWidth: width, strokeStyle: colour });
      context.stroke(bar);
    }
    context.font = '600 11px system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'bottom';
    outlined(context, text, right, y - 6, theme.ink);
  }
}

// A mark whose shape tells its severity without its colour: a triangle, a diamond, a ring.
function drawMark(context, x, y, size, severity, chosen) {
  context.beginPath();
  const corners = { error: [[0, -1], [0.95, 0.7], [-0.95, 0.7]], warning: [[0, -1], [1, 0], [0, 1], [-1, 0]] }[severity];
  if (corners) corners.forEach(([dx, dy], i) => context[i ? 'lineTo' : 'moveTo'](x + dx * size, y + dy * size));
  else context.arc(x, y, size * 0.8, 0, 2 * Math.PI);
  context.closePath();
  context.lineJoin = 'round';
  context.lineWidth = 5;
  context.strokeStyle = theme.plate;
  context.stroke();
  context.lineWidth = 2.25;
  context.strokeStyle = theme[severity];
  context.stroke();
  if (!chosen) return;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(x, y, size + 9, 0, 2 * Math.PI);
  context.stroke();
}

function outlined(context, text, x, y, colour) {
  context.lineWidth = 3;
  context.lineJoin = 'round';
  context.strokeStyle = theme.plate;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

class Stage {
  constructor(element, drawing, sides, programs, items) {
    Object.assign(this, { element, drawing, sides, programs, items });
    this.on = Object.fromEntries(LAYERS.map(layer => [layer.id, layer.on]));
    this.outline = drawing.outline ? new Path2D(drawing.outline) : null;
    this.holes = drawing.holes.map(([diameter, count, text]) => [diameter, count, new Path2D(text)]);
    this.view = { x: 0, y: 0, scale: 0.01 };
    this.behind = false;
    this.cost = 0;
    this.listeners = [];
    this.panes = [];
    this.scratches = [];
    new ResizeObserver(() => this.resize()).observe(element);
  }

  // Shows one side, or both beside each other.
  show(mode) {
    const shown = mode === 'both' ? this.sides : this.sides.filter(side => side.side === mode);
    this.mode = mode;
    this.hover = null;
    this.panes = shown.map(side => new Pane(this, side));
    this.element.replaceChildren(...this.panes.map(pane => pane.element));
    this.resize();
  }

  resize() {
    const [width, height] = [this.element.clientWidth, this.element.clientHeight];
    this.panes.forEach(pane => pane.resize());
    if (this.view === this.all) this.fitted = false;
    if (!this.fitted && width && height) { this.fitted = true; this.fit(false); }
    this.update();
  }

  scratch(width, height) {
    for (let i = 0; i < 2; i++) {
      const context = this.scratches[i] ??= document.createElement('canvas').getContext('2d');
      if (context.canvas.width !== width || context.canvas.height !== height) Object.assign(context.canvas, { width, height });
    }
    return this.scratches;
  }

  // The view that shows all of the board.
  whole() {
    const [left, bottom, right, top] = this.drawing.bounds, pane = this.panes[0];
    const scale = Math.min((pane.width - 64) / (right - left || 1), (pane.height - 72) / (top - bottom || 1));
    return { x: (left + right) / 2, y: (bottom + top) / 2, scale: Math.max(1e-4, scale) };
  }

  // The view of a place: close, but of one beside the board no closer than shows how it lies to it.
  around(x, y) {
    const pane = this.panes[0], [dx, dy] = beside(this.drawing.bounds, x, y);
    const close = Math.max(this.whole().scale * 1.5, pane.width / 5000), some = 5000;
    return { x, y, scale: dx || dy ? Math.min(close, pane.width / 2 / (dx + some), pane.height / 2 / (dy + some)) : close };
  }

  fit(smooth = true) { this.go(this.all = this.whole(), smooth); }

  zoom(factor, px, py, pane = this.panes[0]) {
    const at = pane.toBoard(px ?? pane.width / 2, py ?? pane.height / 2);
    const scale = Math.min(4, Math.max(this.whole().scale / 4, this.view.scale * factor));
    const kept = this.view.scale / scale;
    this.view = { scale, x: at[0] + (this.view.x - at[0]) * kept, y: at[1] + (this.view.y - at[1]) * kept };
    this.moved();
  }

  pan(dx, dy, pane = this.panes[0]) {
    this.view = { ...this.view, x: this.view.x - pane.flip * dx / this.view.scale, y: this.view.y + dy / this.view.scale };
    this.moved();
  }

  // Goes to a view, all the way at once for those who want no motion.
  go(view, smooth = true) {
    cancelAnimationFrame(this.flight);
    if (!smooth || prefersStill.matches) { this.view = view; this.moved(); return; }
    const from = this.view, start = performance.now();
    const fly = now => {
      const t = Math.min(1, (now - start) / 420), ease = 1 - (1 - t) ** 3;
      const scale = from.scale * (view.scale / from.scale) ** ease;
      // The target is kept in sight: places go with the reciprocal of the scale.
      const part = Math.abs(view.scale - from.scale) < 1e-9 ? ease : (1 / scale - 1 / from.scale) / (1 / view.scale - 1 / from.scale);
      this.view = { scale, x: from.x + (view.x - from.x) * part, y: from.y + (view.y - from.y) * part };
      this.moved();
      if (t < 1) this.flight = requestAnimationFrame(fly); else { this.view = view; this.moved(); }
    };
    this.flight = requestAnimationFrame(fly);
  }

  // The view moved: at once where drawing is quick, else when it rests.
  moved() {
    if (this.cost < 20) return this.update();
    this.panes.forEach(pane => pane.shift());
    this.point();
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.update(), 110);
  }

  // Everything anew, in the next frame.
  update() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const start = performance.now();
      this.panes.forEach(pane => { pane.render(); pane.drawOver(); });
      this.cost = performance.now() - start;
      this.element.dataset.drawn = String(+(this.element.dataset.drawn ?? 0) + 1);
    });
  }

  // Only what points at something.
  point() {
    if (this.pointing) return;
    this.pointing = requestAnimationFrame(() => { this.pointing = 0; this.panes.forEach(pane => pane.drawOver()); });
  }
}
