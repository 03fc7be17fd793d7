// One side of the board: its nets, the regions between them, and what is found at a place.

class BoardSide {
  constructor(drawing, layer) {
    this.side = drawing.side;
    this.kerfs = drawing.kerfs;
    this.nets = drawing.nets.map((net, id) => ({
      id, label: net.label, name: layer.nets[id].name, named: layer.nets[id].named, features: layer.nets[id].features,
      paths: net.paths.map(([width, box, text]) => ({ width, box, path: new Path2D(text) })),
    }));
    this.edges = drawing.edges.map(decodeEdge);
    this.lines = new Path2D();
    for (const edge of this.edges) {
      if (edge.left === -1 || edge.right === -1) continue;
      this.lines.moveTo(edge.x[0], edge.y[0]);
      for (let n = 1; n < edge.length; n++) edge.draw(this.lines, n);
    }
    this.hues = chooseHues(this.nets.length, this.edges);
    this.regions = regionPaths(this.nets.length, this.edges);
    this.heat = heatPaths(this.edges, clearance => this.room(clearance));
  }

  // How much of the clearance at a place a cut leaves: below zero where it removes copper. Of
  // several tools the widest that fits cuts there, and one that may rise is no wider than the gap.
  room(clearance) {
    for (const [least, most] of this.kerfs) {
      if (2 * clearance >= most) return clearance - most / 2;
      if (2 * clearance >= least) return 0;
    }
    const finest = this.kerfs[this.kerfs.length - 1];
    return clearance - (finest ? finest[0] : 0) / 2;
  }

  // The net whose copper covers a place.
  netAt(x, y) {
    const inside = ({ width, box, path }) => {
      if (x < box[0] || x > box[2] || y < box[1] || y > box[3]) return false;
      if (!width) return probe.isPointInPath(path, x, y);
      probe.lineWidth = width;
      return probe.isPointInStroke(path, x, y);
    };
    return this.nets.find(net => net.paths.some(inside));
  }

  // The line between regions nearest to a place, within reach: its two owners and the distance to copper there.
  edgeAt(x, y, reach) {
    let best = null;
    for (const edge of this.edges) {
      const [left, bottom, right, top] = edge.extent;
      if (x < left - reach || x > right + reach || y < bottom - reach || y > top + reach) continue;
      for (let n = 1; n < edge.length; n++) {
        const [off] = edge.distance(n, x, y);
        if (off > (best?.off ?? reach)) continue;
        // Between two places it is nowhere less than at the nearer.
        const clearance = Math.min(edge.clearance[n - 1], edge.clearance[n]);
        best = { off, clearance, owners: [edge.left, edge.right].map(owner => this.owner(owner)) };
      }
    }
    return best;
  }

  owner(id) {
    return id === -1 ? 'the edge' : id === -2 ? 'bare board' : this.nets[id].name;
  }
}

// Never shown: it answers whether a place is on a path.
const probe = document.createElement('canvas').getContext('2d');
probe.lineCap = probe.lineJoin = 'round';

// A hue for each net, such that neighbours differ: the least used of those that no neighbour has.
function chooseHues(count, edges) {
  const HUES = [218, 160, 262, 195, 318, 88, 238, 140, 0, 40];
  const near = Array.from({ length: count }, () => new Set());
  for (const { left, right } of edges) if (left >= 0 && right >= 0) { near[left].add(right); near[right].add(left); }
  const chosen = [], used = HUES.map(() => 0);
  for (let net = 0; net < count; net++) {
    const taken = new Set([...near[net]].map(other => chosen[other]));
    let free = HUES.map((_, i) => i).filter(i => !taken.has(i));
    if (!free.length) free = HUES.map((_, i) => i);
    const least = free.reduce((a, b) => (used[b] < used[a] ? b : a));
    used[least] += 1;
    chosen.push(least);
  }
  return chosen.map(i => HUES[i]);
}

// The region of each net: the lines that have it on one side, walked with it on the left, end to end. To be filled by the even-odd rule.
function regionPaths(count, edges) {
  const starts = Array.from({ length: count }, () => new Map());
  const key = (edge, n) => `${edge.x[n]},${edge.y[n]}`;
  for (const edge of edges) {
    const ends = [key(edge, 0), key(edge, edge.length - 1)];
    for (const [owner, back] of [[edge.left, false], [edge.right, true]]) {
      if (owner < 0) continue;
      const [from, to] = back ? [ends[1], ends[0]] : ends;
      const ways = starts[owner].get(from);
      if (ways) ways.push({ edge, back, to }); else starts[owner].set(from, [{ edge, back, to }]);
    }
  }
  return starts.map(ways => {
    const path = new Path2D();
    for (const [first, leaving] of ways) {
      while (leaving.length) {
        let step = leaving.pop();
        const at = step.back ? step.edge.length - 1 : 0;
        path.moveTo(step.edge.x[at], step.edge.y[at]);
        while (step) {
          const { edge, back } = step;
          if (back) for (let n = edge.length - 1; n > 0; n--) edge.drawBack(path, n);
          else for (let n = 1; n < edge.length; n++) edge.draw(path, n);
          step = step.to === first ? null : ways.get(step.to)?.pop();
        }
        path.closePath();
      }
    }
    return path;
  });
}

// The lines by how far a cut may move before it touches copper: a path for each stop of the scale.
function heatPaths(edges, room) {
  const paths = CLEARANCE.map(() => new Path2D());
  for (const edge of edges) {
    if (edge.left === -1 || edge.right === -1) continue;
    let last = -1;
    for (let n = 1; n < edge.length; n++) {
      const stop = clearanceStop(room(Math.min(edge.clearance[n - 1], edge.clearance[n])));
      if (stop !== last) paths[stop].moveTo(edge.x[n - 1], edge.y[n - 1]);
      edge.draw(paths[stop], n);
      last = stop;
    }
  }
  return paths;
}
