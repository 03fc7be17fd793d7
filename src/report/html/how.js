// How the cuts are found, drawn from this board when somebody asks: copper with slopes that fall
// away from it, at a slant and from above.

// The nets of a side on a raster, turned by an angle: of each pixel the nearest net and how far it is, in pixels.
function nearestNets(side, bounds, columns, angle) {
  const { pen, rows, inside } = raster(bounds, columns, angle, 1);
  // Colours far from each other: what is mixed along an edge is none of them.
  const codes = new Map(side.nets.map(net => [((net.id + 1) * 0x9e3779b1 >>> 8) & 0xffffff, net.id]));
  for (const [code, id] of codes) {
    pen.fillStyle = pen.strokeStyle = `#${code.toString(16).padStart(6, '0')}`;
    for (const { width, path } of side.nets[id].paths) {
      if (width) { pen.lineWidth = width; pen.stroke(path); } else pen.fill(path, 'evenodd');
    }
  }
  const bytes = pen.getImageData(0, 0, columns, rows).data;
  const net = new Int32Array(columns * rows).fill(-1), off = new Float64Array(columns * rows).fill(Infinity);
  for (let i = 0; i < net.length; i++) {
    const id = bytes[4 * i + 3] === 255 ? codes.get(bytes[4 * i] << 16 | bytes[4 * i + 1] << 8 | bytes[4 * i + 2]) : undefined;
    if (id !== undefined) { net[i] = id; off[i] = 0; }
  }
  spread(net, off, columns, rows);
  return { net, off, columns, rows, inside };
}

// Exact distances on a raster, first along columns, then along rows: the lower envelope of
// parabolas (Felzenszwalb and Huttenlocher, 2012).
function spread(net, off, columns, rows) {
  for (let x = 0; x < columns; x++) {
    for (const step of [columns, -columns]) {
      let i = step > 0 ? x : x + columns * (rows - 1);
      for (let y = 1; y < rows; y++, i += step) {
        if (off[i] + 1 < off[i + step]) { off[i + step] = off[i] + 1; net[i + step] = net[i]; }
      }
    }
  }
  const [at, from] = [new Int32Array(columns), new Float64Array(columns + 1)];
  for (let row = 0; row < rows; row++) {
    const start = row * columns, [heights, nets] = [off.slice(start, start + columns), net.slice(start, start + columns)];
    let last = -1;
    for (let x = 0; x < columns; x++) {
      if (heights[x] === Infinity) continue;
      let meets = -Infinity;
      for (; last >= 0; last--) {
        const p = at[last];
        meets = (heights[x] ** 2 + x ** 2 - heights[p] ** 2 - p ** 2) / (2 * (x - p));
        if (meets > from[last]) break;
      }
      last += 1;
      at[last] = x;
      from[last] = last ? meets : -Infinity;
    }
    if (last < 0) continue;
    for (let x = 0, k = 0; x < columns; x++) {
      while (k < last && from[k + 1] < x) k += 1;
      off[start + x] = Math.hypot(heights[at[k]], x - at[k]);
      net[start + x] = nets[at[k]];
    }
  }
}

function rgb(hue, saturation, lightness) {
  const a = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map(n => { const k = (n + hue / 30) % 12; return 255 * (lightness - a * Math.max(-1, Math.min(k - 3, 9 - k, 1))); });
}

// The colour of a pixel: copper bright, slopes by the light from the upper left, black where two
// nets are equally far.
function shade({ net, off, columns, rows }, hues, x, y, flat) {
  const i = y * columns + x, [right, below] = [x + 1 < columns ? i + 1 : i, y + 1 < rows ? i + columns : i];
  if (net[i] !== net[right] || net[i] !== net[below]) return [14, 16, 20];
  if (off[i] === 0) return rgb(hues[net[i]], 0.62, 0.74);
  const light = flat ? 0 : (off[right] - off[i]) * 0.5 + (off[below] - off[i]) * 0.7;
  return rgb(hues[net[i]], 0.5, 0.44 - 0.17 * light);
}

// Seen from so much above the board.
function slopes(side, bounds) {
  const seen = nearestNets(side, bounds, 680, -0.42), { off, columns, rows, inside } = seen;
  const down = (x, y) => Math.min(off[y * columns + x], rows);
  return slanted({ columns, rows, inside, down, wall: 0 }, 'Copper with slopes that fall away from it, seen at a slant', (x, y) => shade(seen, side.hues, x, y, false));
}

function fromAbove(side, bounds) {
  const seen = nearestNets(side, bounds, 680, 0);
  return picture(seen.columns, seen.rows, 'The same from above: the regions of the nets, and the lines between them', dot => {
    for (let y = 0; y < seen.rows; y++) for (let x = 0; x < seen.columns; x++) dot(x, y, shade(seen, side.hues, x, y, true));
  });
}

// Both pictures with what they show.
function howFound(side, bounds) {
  return [
    make('p', { class: 'how' }, 'Every net is a plateau of copper from which slopes fall away, equally steep for all:'), slopes(side, bounds),
    make('p', { class: 'how' }, 'From above each slope covers what is nearest to its net. Where two of them meet, both nets are equally far: there one cut parts them and leaves each as much copper as it can have.'), fromAbove(side, bounds),
  ];
}
