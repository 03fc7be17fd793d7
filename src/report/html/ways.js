// Ways: what boundaries and programs run along, decoded from the compact text that the page carries.
// A way is columns of numbers: step n runs from point n to point n + 1, straight (turn 0) or round a centre.

const LETTERS = /[a-z]|-?\d+/g;

class Way {
  x = []; y = []; turn = [0]; cx = [0]; cy = [0];

  get length() { return this.x.length; }

  go(x, y, turn = 0, cx = 0, cy = 0) {
    if (this.x.length) { this.turn.push(turn); this.cx.push(cx); this.cy.push(cy); }
    this.x.push(x);
    this.y.push(y);
  }

  // Adds the step that ends at point n to a path that is at point n - 1.
  draw(path, n) {
    if (!this.turn[n]) return path.lineTo(this.x[n], this.y[n]);
    const { cx, cy, from, to, radius } = this.arc(n);
    path.arc(cx, cy, radius, from, to, this.turn[n] < 0);
  }

  // The same from its end to its start.
  drawBack(path, n) {
    if (!this.turn[n]) return path.lineTo(this.x[n - 1], this.y[n - 1]);
    const { cx, cy, from, to, radius } = this.arc(n);
    path.arc(cx, cy, radius, to, from, this.turn[n] > 0);
  }

  arc(n) {
    const cx = this.cx[n], cy = this.cy[n];
    const from = Math.atan2(this.y[n - 1] - cy, this.x[n - 1] - cx);
    let to = Math.atan2(this.y[n] - cy, this.x[n] - cx);
    const whole = this.x[n] === this.x[n - 1] && this.y[n] === this.y[n - 1];
    if (this.turn[n] > 0 && (to <= from || whole)) to += 2 * Math.PI;
    if (this.turn[n] < 0 && (to >= from || whole)) to -= 2 * Math.PI;
    return { cx, cy, from, to, radius: Math.hypot(this.x[n - 1] - cx, this.y[n - 1] - cy) };
  }

  stepLength(n) {
    if (!this.turn[n]) return Math.hypot(this.x[n] - this.x[n - 1], this.y[n] - this.y[n - 1]);
    const { from, to, radius } = this.arc(n);
    return Math.abs(to - from) * radius;
  }

  // The point at a fraction of the step that ends at point n.
  at(n, fraction) {
    if (!this.turn[n]) {
      const mix = (a, b) => a + (b - a) * fraction;
      return [mix(this.x[n - 1], this.x[n]), mix(this.y[n - 1], this.y[n])];
    }
    const { cx, cy, from, to, radius } = this.arc(n);
    const angle = from + (to - from) * fraction;
    return [cx + radius * Math.cos(angle), cy + radius * Math.sin(angle)];
  }

  // How far a place is from the step that ends at point n, and at which fraction of it.
  distance(n, px, py) {
    const ax = this.x[n - 1], ay = this.y[n - 1], bx = this.x[n], by = this.y[n];
    if (!this.turn[n]) {
      const square = (bx - ax) ** 2 + (by - ay) ** 2;
      const along = square ? ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / square : 0;
      const fraction = Math.min(1, Math.max(0, along));
      return [Math.hypot(px - ax - (bx - ax) * fraction, py - ay - (by - ay) * fraction), fraction];
    }
    const { cx, cy, from, to, radius } = this.arc(n);
    const turn = Math.sign(to - from);
    let angle = (Math.atan2(py - cy, px - cx) - from) * turn;
    angle -= Math.floor(angle / (2 * Math.PI)) * 2 * Math.PI;
    const sweep = Math.abs(to - from);
    if (angle <= sweep) return [Math.abs(Math.hypot(px - cx, py - cy) - radius), angle / sweep];
    const [first, last] = [Math.hypot(px - ax, py - ay), Math.hypot(px - bx, py - by)];
    return first < last ? [first, 0] : [last, 1];
  }

  // Left, bottom, right, top of the points from one to another, with room for arcs.
  box(first = 0, last = this.length - 1) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let n = first; n <= last; n++) {
      const bulge = n > first && this.turn[n] ? Math.hypot(this.x[n] - this.cx[n], this.y[n] - this.cy[n]) : 0;
      const x = bulge ? this.cx[n] : this.x[n], y = bulge ? this.cy[n] : this.y[n];
      box[0] = Math.min(box[0], x - bulge); box[1] = Math.min(box[1], y - bulge);
      box[2] = Math.max(box[2], x + bulge); box[3] = Math.max(box[3], y + bulge);
    }
    return box;
  }
}

// Calls act(letter, numbers) for each letter of a text with as many numbers as the letter takes.
function spell(text, takes, act) {
  let letter = '', numbers = [];
  for (const token of text.match(LETTERS) ?? []) {
    if (token in takes) { letter = token; numbers = []; continue; }
    numbers.push(+token);
    if (numbers.length === takes[letter]) { act(letter, numbers); numbers = []; }
  }
}

// A line between two regions; `clearance` holds the distance to copper at each point.
function decodeEdge([left, right, text]) {
  const way = Object.assign(new Way(), { left, right, clearance: [] });
  let x = 0, y = 0, clear = 0;
  spell(text, { s: 3, l: 3, a: 5, c: 5 }, (letter, [dx, dy, p, q, r]) => {
    const turn = letter === 'a' ? 1 : letter === 'c' ? -1 : 0;
    const [cx, cy] = [x + p, y + q];
    x += dx; y += dy; clear += turn ? r : p;
    way.go(x, y, turn, turn ? cx : 0, turn ? cy : 0);
    way.clearance.push(clear);
  });
  way.extent = way.box();
  return way;
}

// A program's motions; `z`, `feed`, `cutter` and `line` belong to the step that ends at the point.
function decodeMotions(text) {
  const way = Object.assign(new Way(), { z: [], feed: [], rapid: [], cutter: [], line: [] });
  let x = 0, y = 0, z = 0, feed = 0, cutter = 0, line = 0, lines = 0;
  const add = (turn, rapid, cx, cy) => {
    line += lines; lines = 1;
    way.go(x, y, turn, cx, cy);
    way.z.push(z); way.feed.push(feed); way.rapid.push(rapid); way.cutter.push(cutter); way.line.push(line);
  };
  spell(text, { s: 3, r: 2, f: 2, a: 4, c: 4, z: 1, v: 1, t: 1, n: 1 }, (letter, [p, q, r, s]) => {
    switch (letter) {
      case 's': x = p; y = q; z = r; add(0, true, 0, 0); break;
      case 'z': z = p; break;
      case 'v': feed = p; break;
      case 't': cutter = p; break;
      case 'n': lines = p; break;
      case 'r': case 'f': x += p; y += q; add(0, letter === 'r', 0, 0); break;
      default: { const [cx, cy] = [x + r, y + s]; x += p; y += q; add(letter === 'a' ? 1 : -1, false, cx, cy); }
    }
  });
  return way;
}

const meets = (a, b) => a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
