// Pictures that the page makes itself, pixel by pixel: rasters of the board, and what lies on them seen at a slant.

// A pen for a raster so many pixels wide, in micrometres, turned by an angle and mirrored where `flip` is -1; and which
// pixels lie within the bounds.
function raster([left, bottom, right, top], columns, angle, flip) {
  const [wide, high] = [right - left, top - bottom], [c, s] = [Math.cos(angle), Math.sin(angle)];
  const scale = columns / (wide * Math.abs(c) + high * Math.abs(s));
  const rows = Math.max(1, Math.round((wide * Math.abs(s) + high * Math.abs(c)) * scale));
  const pen = make('canvas', { width: columns, height: rows }).getContext('2d', { willReadFrequently: true });
  pen.translate(columns / 2, rows / 2);
  pen.rotate(angle);
  pen.scale(flip * scale, -scale);
  pen.translate(-(left + right) / 2, -(bottom + top) / 2);
  pen.lineCap = pen.lineJoin = 'round';
  const inside = (x, y) => {
    const [u, v] = [x + 0.5 - columns / 2, y + 0.5 - rows / 2];
    return Math.abs(u * c + v * s) <= wide * scale / 2 && Math.abs(v * c - u * s) <= high * scale / 2;
  };
  return { pen, columns, rows, scale, inside };
}

function picture(width, height, label, paint) {
  const canvas = make('canvas', { width, height, role: 'img', 'aria-label': label });
  const pen = canvas.getContext('2d'), image = pen.createImageData(width, height);
  paint((x, y, colour) => image.data.set([...colour, 255], 4 * (y * width + x)));
  pen.putImageData(image, 0, 0);
  return canvas;
}

// What lies `down` so many pixels, from above at a slant, with walls so high where it ends: columns from the front to
// the back, each pixel above what is drawn already.
function slanted({ columns, rows, inside, down, wall }, label, colour) {
  const [lie, stand] = [Math.sin(1.0), Math.cos(1.0)], height = Math.ceil(rows * (lie + stand)) + wall;
  const at = (x, y) => Math.min(height, Math.round(y * lie + down(x, y) * stand));
  const edge = Math.max(1, Math.round(wall * stand));
  let [top, bottom] = [height, 0];
  for (let y = 0; y < rows; y++) {
    for (let x = 0; x < columns; x++) if (inside(x, y)) [top, bottom] = [Math.min(top, at(x, y)), Math.max(bottom, at(x, y) + edge)];
  }
  bottom = Math.min(bottom, height);
  return picture(columns, Math.max(bottom - top, 1), label, dot => {
    for (let x = 0; x < columns; x++) {
      let [drawn, ends] = [bottom, true];
      for (let y = rows - 1; y >= 0; y--) {
        if (!inside(x, y)) { ends = true; continue; }
        const own = colour(x, y), upTo = at(x, y);
        if (ends) {
          drawn = Math.min(drawn, upTo + edge);
          const dark = wall ? own.map(part => part * 0.45) : own;
          while (drawn > upTo + 1) { drawn -= 1; dot(x, drawn - top, dark); }
          ends = false;
        }
        while (drawn > upTo) { drawn -= 1; dot(x, drawn - top, own); }
      }
    }
  });
}
