// The board as it comes from the mill, at a slant: how deep its programs cut, lit from the upper left.

// So many times as deep as they are grooves look, and so many steps have their slopes.
const DEEPER = 3, STEPS = 8;
const METAL = [214, 144, 92], LAMINATE = [186, 178, 122], COPPER_UM = 35;

// How deep a side is at each pixel, in micrometres; holes and what lies off the board are no pixels of it.
function depths(stage, side, columns, angle) {
  const { bounds } = stage.drawing, flip = side.side === 'back' ? -1 : 1;
  const board = raster(bounds, columns, angle, flip), cut = raster(bounds, columns, angle, flip);
  const programs = stage.programs.filter(program => program.side === side.side);
  const runs = programs.flatMap(program => program.runs.map(run => {
    let deep = 0;
    for (let n = run.first; n <= run.last; n++) deep = Math.max(deep, -program.way.z[n]);
    return { run, deep, cutter: program.cutters[program.way.cutter[run.first]] ?? [run.width, 0] };
  }));
  const deepest = Math.max(1, ...runs.map(run => run.deep)), { pen } = cut;
  pen.globalCompositeOperation = 'lighten';
  for (const { run, deep, cutter: [tip, wider] } of runs) {
    const steps = wider ? STEPS : 1;
    for (let step = 1; step <= steps; step++) {
      const grey = Math.round(255 * deep / deepest * step / steps);
      pen.strokeStyle = `rgb(${grey} ${grey} ${grey})`;
      pen.lineWidth = Math.max(tip + wider * deep * (1 - (step - 0.5) / steps), 0.7 / cut.scale);
      pen.stroke(run.path);
    }
  }
  board.pen.fillStyle = board.pen.strokeStyle = '#fff';
  if (stage.outline) board.pen.fill(stage.outline, 'evenodd'); else board.pen.fillRect(bounds[0], bounds[1], bounds[2] - bounds[0], bounds[3] - bounds[1]);
  board.pen.globalCompositeOperation = 'destination-out';
  for (const [diameter, , path] of stage.holes) { board.pen.lineWidth = diameter; board.pen.stroke(path); }
  const [stock, grey] = [board.pen, pen].map(each => each.getImageData(0, 0, columns, cut.rows).data);
  return {
    columns, rows: cut.rows, scale: cut.scale,
    deep: Float64Array.from({ length: columns * cut.rows }, (_, i) => grey[4 * i] / 255 * deepest),
    inside: (x, y) => stock[4 * (y * columns + x) + 3] > 127,
  };
}

// A side of a board so many micrometres thick.
function asMilled(stage, side, thickness) {
  const seen = depths(stage, side, 1360, -0.42), { columns, rows, scale, deep, inside } = seen;
  const lit = (x, y) => {
    const i = y * columns + x, [right, below] = [x + 1 < columns ? i + 1 : i, y + 1 < rows ? i + columns : i];
    const light = ((deep[right] - deep[i]) * 0.5 + (deep[below] - deep[i]) * 0.7) * DEEPER * scale;
    const own = deep[i] > COPPER_UM * 0.8 ? LAMINATE : METAL;
    return own.map(part => Math.max(0, Math.min(255, part * (1 - Math.max(-0.35, Math.min(0.6, light))))));
  };
  return slanted({ columns, rows, inside, down: (x, y) => deep[y * columns + x] * DEEPER * scale, wall: Math.round(thickness * scale) },
    `The ${side.side} as it comes from the mill, seen at a slant`, lit);
}
