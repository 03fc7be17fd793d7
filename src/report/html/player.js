// The player: all programs on one line of time, in the order in which they are run.

class Player {
  constructor(stage) {
    this.stage = stage;
    this.programs = stage.programs;
    this.starts = [];
    this.total = 0;
    for (const program of this.programs) { this.starts.push(this.total); this.total += program.seconds; }
    this.now = this.total;
    this.speed = 60;
    this.playing = false;
    this.changed = () => {};
  }

  // The program that runs now.
  get index() {
    let index = this.starts.findLastIndex(start => start <= this.now);
    if (this.now >= this.total) index = this.programs.length - 1;
    return Math.max(0, index);
  }

  // How far a program has come.
  done(program) {
    const index = this.programs.indexOf(program), seconds = this.now - this.starts[index];
    if (seconds >= program.seconds) return { n: program.motions, fraction: 1 };
    if (seconds <= 0) return { n: 0, fraction: 0 };
    return program.at(seconds);
  }

  // Where the tool is; none before the start and when all is done.
  tool() {
    if (this.now <= 0 || this.now >= this.total || !this.programs.length) return null;
    const program = this.programs[this.index], { way } = program;
    const { n, fraction } = program.at(this.now - this.starts[this.index]);
    const [x, y] = way.at(n, fraction);
    return { program, n, x, y, z: way.z[n - 1] + (way.z[n] - way.z[n - 1]) * fraction, line: way.line[n] };
  }

  seek(seconds) {
    this.now = Math.min(this.total, Math.max(0, seconds));
    this.stage.update();
    this.changed();
  }

  // To where a motion of a program ends.
  seekTo(program, n) { this.seek(this.starts[this.programs.indexOf(program)] + program.ends[n]); }

  play(on = !this.playing) {
    if (on && this.now >= this.total) this.now = 0;
    this.playing = on && this.total > 0;
    this.stage.update();
    this.last = performance.now();
    if (this.playing) requestAnimationFrame(now => this.tick(now));
    this.changed();
  }

  tick(now) {
    if (!this.playing) return;
    const passed = Math.min(0.25, (now - this.last) / 1000);
    this.last = now;
    this.advance(passed * this.speed);
    if (this.now >= this.total) this.play(false); else this.changed();
    if (this.playing) requestAnimationFrame(next => this.tick(next));
  }

  // Draws only what was cut meanwhile where that is all that changes.
  advance(seconds) {
    const before = this.programs.map(program => this.done(program).n);
    this.now = Math.min(this.total, this.now + seconds);
    const { on, panes } = this.stage;
    const cutsOut = on.cutout && this.programs[this.index].part === 'cutout';
    if (on.heat || cutsOut || this.stage.frame) { this.stage.update(); return; }
    for (const pane of panes) {
      for (const program of pane.programs) {
        const from = before[this.programs.indexOf(program)], done = this.done(program);
        if (done.n === 0 || (from === program.motions && done.n === from)) continue;
        pane.drawMore(program, Math.max(0, from - 1), done);
      }
      pane.drawOver();
    }
  }
}
