// One program: what its cutter does over the board, motion by motion.

class Program {
  constructor(drawing) {
    Object.assign(this, drawing);
    this.way = decodeMotions(drawing.motions);
    this.motions = this.way.length - 1;
    this.clock();
    this.runs = this.group();
    this.rapids = new Path2D();
    for (let n = 1; n <= this.motions; n++) {
      if (this.down(n)) continue;
      if (this.down(n - 1) || n === 1) this.rapids.moveTo(this.way.x[n - 1], this.way.y[n - 1]);
      this.way.draw(this.rapids, n);
    }
  }

  // Whether the step that ends at point n runs below the surface.
  down(n) { return n > 0 && Math.min(this.way.z[n - 1], this.way.z[n]) < 0; }

  // How wide the cutter cuts in the step that ends at point n.
  kerf(n) {
    const [tip, wider] = this.cutters[this.way.cutter[n]] ?? [100, 0];
    const [from, to] = [-this.way.z[n - 1], -this.way.z[n]];
    return tip + wider * Math.max(0, this.level(n) ? (from + to) / 2 : Math.max(from, to));
  }

  level(n) { return this.way.x[n] !== this.way.x[n - 1] || this.way.y[n] !== this.way.y[n - 1]; }

  // When each motion ends, in seconds: lengths over feeds, stretched to the time that the planner knows with its ramps.
  clock() {
    const { way } = this, ends = new Float64Array(way.length);
    for (let n = 1; n < way.length; n++) {
      const climb = way.z[n] - way.z[n - 1];
      const speed = way.rapid[n] ? this.rapid : way.feed[n] || this.rapid;
      ends[n] = ends[n - 1] + Math.hypot(way.stepLength(n), climb) / 1000 / speed * 60;
    }
    const total = ends[way.length - 1] || 1;
    this.ends = ends.map(end => end * this.seconds / total);
  }

  // The motion that runs at a time, and how much of it is done.
  at(seconds) {
    let [low, high] = [1, this.motions];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.ends[middle] < seconds) low = middle + 1; else high = middle;
    }
    const span = this.ends[low] - this.ends[low - 1];
    return { n: low, fraction: span > 0 ? Math.min(1, Math.max(0, (seconds - this.ends[low - 1]) / span)) : 1 };
  }

  // Cuts of one width, at most 400 motions each.
  group() {
    const runs = [];
    let run = null;
    for (let n = 1; n <= this.motions; n++) {
      if (!this.down(n)) { run = null; continue; }
      const width = Math.max(2, Math.round(this.kerf(n) / 2) * 2);
      if (!run || run.width !== width || n - run.first >= 400) runs.push(run = { first: n, last: n, width });
      run.last = n;
    }
    for (const run of runs) {
      run.path = this.trace(run.first, run.last);
      const [left, bottom, right, top] = this.way.box(run.first - 1, run.last);
      run.box = [left - run.width, bottom - run.width, right + run.width, top + run.width];
    }
    return runs;
  }

  // The steps from one to another as a path; a plunge as a spot.
  trace(first, last, fraction = 1) {
    const path = new Path2D(), { way } = this;
    path.moveTo(way.x[first - 1], way.y[first - 1]);
    for (let n = first; n <= last; n++) {
      if (n === last && fraction < 1) {
        for (let part = 1; part <= 8; part++) path.lineTo(...way.at(n, fraction * part / 8));
      } else if (this.level(n) || way.turn[n]) {
        way.draw(path, n);
      } else {
        path.lineTo(way.x[n] + 1, way.y[n]);
      }
    }
    return path;
  }

  // The motion below the surface nearest to a place, within reach.
  motionAt(x, y, reach) {
    let best = null;
    for (const { first, last, width, box } of this.runs) {
      if (x < box[0] - reach || x > box[2] + reach || y < box[1] - reach || y > box[3] + reach) continue;
      for (let n = first; n <= last; n++) {
        const [off] = this.way.distance(n, x, y);
        if (off <= Math.min(best?.off ?? Infinity, Math.max(reach, width / 2))) best = { off, n, width };
      }
    }
    return best;
  }
}
