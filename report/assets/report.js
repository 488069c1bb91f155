// Decides how the figures of a report answer to the reader: zoom, move, read values, hide curves, x axes that move together.
// The static pictures of the page show the same without it. The ticks follow report/page/ticks.cpp.
'use strict';
(() => {
  const body = document.body;
  body.dataset.errors = '0';
  const failed = () => { body.dataset.errors = String(Number(body.dataset.errors) + 1); };
  addEventListener('error', failed);
  addEventListener('securitypolicyviolation', failed);

  // ---- numbers and ticks -----------------------------------------------------------------------------------------

  const superscript = (n) => String(n).replace('-', '⁻').replace(/[0-9]/g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]);
  const minus = (text) => text.replace(/^-/, '−');
  const exponentText = (n) => (n === 0 ? '' : '×10' + superscript(n));

  function niceStep(rough) {
    const power = 10 ** Math.floor(Math.log10(rough));
    return [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * (1 - 1e-9));
  }

  function linearTicks(low, high, count) {
    const step = niceStep((high - low) / Math.max(1, count));
    const largest = Math.max(Math.abs(low), Math.abs(high));
    const exponent = largest >= 1e5 || largest < 1e-2 ? 3 * Math.floor(Math.log10(largest) / 3) : 0;
    const factor = 10 ** exponent;
    const decimals = Math.min(12, Math.max(0, -Math.floor(Math.log10(step / factor) + 1e-9)));
    const list = [];
    for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k)
      list.push({at: k * step + 0, label: minus((k * step / factor + 0).toFixed(decimals))});
    return {list, exponent};
  }

  function logTicks(low, high, count) {  // low, high: decades
    if (high - low < 1) {
      const ticks = linearTicks(10 ** low, 10 ** high, count);
      return {list: ticks.list.filter((t) => t.at > 0).map((t) => ({at: Math.log10(t.at), label: t.label})), exponent: ticks.exponent};
    }
    const stride = Math.max(1, Math.ceil((high - low) / Math.max(1, count)));
    const between = 3 * (high - low) <= count;
    const list = [];
    for (let k = Math.floor(low); k <= Math.ceil(high); ++k) {
      if (k % stride !== 0) continue;
      for (const m of between ? [1, 2, 5] : [1]) {
        const at = k + Math.log10(m);
        if (at < low - 1e-9 || at > high + 1e-9) continue;
        const plain = k >= -3 && k <= 4;
        list.push({at, label: plain ? String(Number((m * 10 ** k).toPrecision(3))) : (m > 1 ? m + '·' : '') + '10' + superscript(k)});
      }
    }
    return {list, exponent: 0};
  }

  /** A value as the reader gets it: as many digits as tell it from its neighbours in what is shown. */
  function valueText(v, span) {
    if (!Number.isFinite(v)) return '–';
    const digits = Math.min(12, Math.max(4, Math.ceil(Math.log10(Math.abs(v) / (span || 1)) + 4) || 4));
    return minus(String(Number(v.toPrecision(digits))));
  }

  // ---- small helpers ---------------------------------------------------------------------------------------------

  const make = (tag, attributes, parent) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (parent) parent.append(element);
    return element;
  };
  const px = (v) => Math.round(v * 10) / 10;
  const clamp = (v, low, high) => Math.min(high, Math.max(low, v));
  const bracket = (label) => { const m = /\[([^\]]*)\]$/.exec(label); return m ? m[1] : ''; };
  const bare = (label) => label.replace(/\s*\[[^\]]*\]$/, '');

  /** First index with values[index] >= v; values increase. */
  function lowerBound(values, v) {
    let low = 0, high = values.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (values[middle] < v) low = middle + 1; else high = middle;
    }
    return low;
  }

  const shades = 12;  // colours of the scale of time, as in report.css
  const shadeOf = (gone) => clamp(Math.floor(gone * shades), 0, shades - 1);

  const groups = new Map();  // figures that move together in x, by their link

  // ---- one figure ------------------------------------------------------------------------------------------------

  class Plot {
    constructor(figure, data) {
      this.figure = figure;
      this.data = data;
      this.picture = figure.querySelector('.picture');
      const place = (values, log) => Float64Array.from(values, (v) => (v === null ? NaN : log ? (v > 0 ? Math.log10(v) : NaN) : v));
      this.curves = data.curves.map((c) => ({...c, x: place(c.x, data.log_x), y: place(c.y, data.log_y), shown: true}));
      const range = (r, log) => (log ? r.map(Math.log10) : r);
      this.fullX = range(data.x, data.log_x);
      this.fullY = this.airy(range(data.y, data.log_y));
      this.viewY = null;  // null: fits what is seen
      this.group = groups.get(data.link) || {viewX: null, plots: [], fullX: [Infinity, -Infinity]};
      if (data.link) groups.set(data.link, this.group);
      this.group.plots.push(this);
      this.group.fullX = [Math.min(this.group.fullX[0], this.fullX[0]), Math.max(this.group.fullX[1], this.fullX[1])];
      this.build();
      this.listen();
    }

    airy([low, high]) {
      const air = 0.05 * (high - low);
      return [low - air, high + air];
    }

    build() {
      this.svg = make('svg', {class: 'plot', role: 'img', 'aria-label': this.data.title});
      this.picture.replaceChildren(this.svg);
      this.picture.tabIndex = 0;
      const id = 'clip' + Plot.count++;
      this.clip = make('rect', {}, make('clipPath', {id}, make('defs', {}, this.svg)));
      this.axes = make('g', {}, this.svg);
      const clipped = make('g', {'clip-path': `url(#${id})`}, this.svg);
      for (const c of this.curves) {
        const css = (colour) => `curve ${c.style}${c.few ? ' few' : ''}${c.under ? ' under' : ''} c-${colour}`;
        c.parts = this.partsOf(c).map(([from, to, colour]) => ({from, to, path: make('path', {class: css(colour)}, clipped)}));
      }
      this.pane = make('rect', {class: 'pane'}, this.svg);
      this.cursor = make('line', {class: 'cursor', visibility: 'hidden', 'pointer-events': 'none'}, clipped);
      this.dots = make('g', {'pointer-events': 'none'}, clipped);
      this.selection = make('rect', {class: 'selection', visibility: 'hidden', 'pointer-events': 'none'}, this.svg);
      this.readout = document.createElement('div');
      this.readout.className = 'readout';
      this.readout.hidden = true;
      this.button = document.createElement('button');
      this.button.className = 'reset';
      this.button.type = 'button';
      this.button.textContent = 'show all';
      this.button.hidden = true;
      this.picture.append(this.readout, this.button);
      const csv = document.createElement('button');
      csv.className = 'csv';
      csv.type = 'button';
      csv.textContent = 'CSV';
      csv.title = 'Save the numbers of this figure';
      csv.addEventListener('click', () => this.save());
      this.picture.append(csv);
    }

    /** Ranges [from, to) of points of one colour: one, or where time is shown by colour one for each colour of its scale. */
    partsOf(c) {
      if (!c.shade) return [[0, c.x.length, c.colour]];
      const parts = [];
      for (let from = 0; from < c.x.length;) {
        const shade = shadeOf(c.shade[from]);
        let to = from + 1;
        while (to < c.x.length && shadeOf(c.shade[to]) === shade) ++to;
        parts.push([from, Math.min(c.x.length, to + 1), 't' + shade]);
        from = to;
      }
      return parts;
    }

    // -- what is seen

    get viewX() { return this.group.viewX || this.group.fullX; }

    // -- its numbers

    /** Columns of the curves as a table: one x where all share it, else each curve with its own. */
    csv() {
      const cell = (text) => '"' + String(text).replaceAll('"', '""') + '"';
      const unit = bracket(this.data.y_label);
      const curves = this.data.curves;
      const shared = curves.every((c) => c.x.length === curves[0].x.length && c.x.every((v, i) => v === curves[0].x[i]));
      const columns = [];
      curves.forEach((c, i) => {
        if (i === 0 || !shared) columns.push([this.data.x_label, c.x]);
        columns.push([`${c.name || bare(this.data.y_label)} [${unit || '1'}]`, c.y]);
      });
      const lines = [columns.map(([name]) => cell(name)).join(',')];
      const rows = Math.max(...columns.map(([, values]) => values.length));
      for (let i = 0; i < rows; ++i) lines.push(columns.map(([, values]) => values[i] ?? '').join(','));
      return lines.join('\n') + '\n';
    }

    save() {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(new Blob([this.csv()], {type: 'text/csv'}));
      link.download = (this.data.title.replace(/[^0-9A-Za-z]+/g, '-').replace(/^-|-$/g, '') || 'figure') + '.csv';
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    }

    /** Indices [from, to) of a curve that can be seen, with one neighbour on each side. */
    visible(curve) {
      if (!curve.monotone) return [0, curve.x.length];
      const [low, high] = this.viewX;
      return [Math.max(0, lowerBound(curve.x, low) - 1), Math.min(curve.x.length, lowerBound(curve.x, high) + 2)];
    }

    seenY() {
      if (this.viewY) return this.viewY;
      const [x0, x1] = this.viewX;
      let low = Infinity, high = -Infinity;
      for (const c of this.curves) {
        if (!c.shown) continue;
        const [from, to] = this.visible(c);
        for (let i = from; i < to; ++i) {
          const inside = c.x[i] >= x0 && c.x[i] <= x1;
          const neighbour = c.monotone && c.style !== 'points';  // its line runs into the view
          if (!Number.isFinite(c.y[i]) || !(inside || neighbour)) continue;
          if (c.y[i] < low) low = c.y[i];
          if (c.y[i] > high) high = c.y[i];
        }
      }
      if (!(high >= low)) return this.fullY;
      if (high > low) return this.airy([low, high]);
      const around = low === 0 ? 1 : 0.1 * Math.abs(low);
      return [low - around, high + around];
    }

    // -- drawing

    draw() {
      this.drawnFor = this.picture.clientWidth;
      const width = Math.max(240, this.picture.clientWidth || (this.data.wide ? 1000 : 490)), height = this.data.height;
      const [y0, y1] = this.seenY(), [x0, x1] = this.viewX;
      const ticksY = this.data.log_y ? logTicks(y0, y1, 6) : linearTicks(y0, y1, 6);
      const longest = Math.max(0, ...ticksY.list.map((t) => t.label.length));
      const left = Math.max(70, 6.6 * longest + 36), right = 16, top = 12, bottom = 48;
      this.box = {left, right: width - right, top, bottom: height - bottom, width, height};
      this.atX = (v) => left + (width - right - left) * (v - x0) / (x1 - x0);
      this.atY = (v) => height - bottom - (height - bottom - top) * (v - y0) / (y1 - y0);
      this.fromX = (p) => x0 + (x1 - x0) * (p - left) / (width - right - left);
      this.fromY = (p) => y0 + (y1 - y0) * (height - bottom - p) / (height - bottom - top);
      this.range = {x: [x0, x1], y: [y0, y1]};
      this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
      for (const r of [this.clip, this.pane]) {
        for (const [key, value] of Object.entries({x: left, y: top, width: width - right - left, height: height - bottom - top}))
          r.setAttribute(key, px(value));
      }
      this.drawAxes(ticksY);
      for (const c of this.curves)
        for (const part of c.parts) part.path.setAttribute('d', c.shown ? this.pathOf(c, part) : '');
      this.button.hidden = !this.group.viewX && !this.viewY;
      this.hideReadout();
      this.figure.dataset.drawn = 'true';
    }

    drawAxes(ticksY) {
      const {left, right, top, bottom, width, height} = this.box, [x0, x1] = this.viewX;
      const ticksX = (this.data.log_x ? logTicks : linearTicks)(x0, x1, Math.max(3, Math.floor((right - left) / 70)));
      const g = this.axes;
      g.replaceChildren();
      const text = (x, y, anchor, content, css) => {
        make('text', {x: px(x), y: px(y), 'text-anchor': anchor, ...(css ? {class: css} : {})}, g).textContent = content;
      };
      for (const t of ticksY.list) {
        const y = px(this.atY(t.at));
        make('line', {class: !this.data.log_y && t.at === 0 ? 'grid zero' : 'grid', x1: left, x2: right, y1: y, y2: y}, g);
        text(left - 8, y + 4, 'end', t.label);
      }
      for (const t of ticksX.list) {
        const x = px(this.atX(t.at));
        make('line', {class: 'grid', x1: x, x2: x, y1: top, y2: bottom}, g);
        text(x, bottom + 17, 'middle', t.label);
      }
      make('line', {class: 'axis', x1: left, x2: right, y1: bottom, y2: bottom}, g);
      text((left + right) / 2, height - 9, 'middle', `${this.data.x_label} ${exponentText(ticksX.exponent)}`.trim(), 'label');
      const label = make('text', {class: 'label', transform: `translate(15 ${px((top + bottom) / 2)}) rotate(-90)`, 'text-anchor': 'middle'}, g);
      const full = `${this.data.y_label} ${exponentText(ticksY.exponent)}`.trim();
      const room = Math.floor((bottom - top + 30) / 6.6);
      label.textContent = full.length > room ? full.slice(0, room - 1) + '…' : full;
    }

    /** Path of the visible part; where there are many points per pixel, first, lowest, highest and last of each pixel. */
    pathOf(c, part) {
      const seen = this.visible(c);
      const from = Math.max(seen[0], part.from), to = Math.min(seen[1], part.to);
      const dense = c.monotone && to - from > 5 * this.box.width;
      const parts = [];
      let pen = false;
      const put = (i) => {
        const x = px(this.atX(c.x[i])), y = px(clamp(this.atY(c.y[i]), -1e5, 1e5));
        if (c.style === 'points') parts.push(`M${x} ${y}h0`);
        else if (!pen) parts.push(`M${x} ${y}`);
        else parts.push(c.style === 'steps' ? `H${x}V${y}` : `L${x} ${y}`);
        pen = true;
      };
      for (let i = from; i < to;) {
        if (!Number.isFinite(c.x[i]) || !Number.isFinite(c.y[i])) { pen = false; ++i; continue; }
        let end = i + 1;
        if (dense) {
          const column = Math.floor(this.atX(c.x[i]));
          let low = i, high = i;
          for (; end < to && Math.floor(this.atX(c.x[end])) === column && Number.isFinite(c.y[end]); ++end) {
            if (c.y[end] < c.y[low]) low = end;
            if (c.y[end] > c.y[high]) high = end;
          }
          for (const k of [...new Set([i, Math.min(low, high), Math.max(low, high), end - 1])]) put(k);
        } else {
          put(i);
        }
        i = end;
      }
      return parts.join('');
    }

    // -- moving

    redrawGroup() { for (const p of this.group.plots) p.draw(); }

    setX(low, high) {
      const [a, b] = this.group.fullX;
      const span = clamp(high - low, (b - a) * 1e-7, b - a);
      const begin = clamp(low, a, b - span);
      this.group.viewX = span >= (b - a) * (1 - 1e-9) ? null : [begin, begin + span];
    }

    reset() {
      this.group.viewX = null;
      for (const p of this.group.plots) p.viewY = null;
      this.redrawGroup();
    }

    zoomAt(x, factor) {
      const [x0, x1] = this.viewX;
      this.setX(x - (x - x0) * factor, x + (x1 - x) * factor);
      this.redrawGroup();
    }

    pan(share) {
      const [x0, x1] = this.viewX;
      this.setX(x0 + share * (x1 - x0), x1 + share * (x1 - x0));
      this.redrawGroup();
    }

    /** A pointer event's place in the coordinates of the SVG. */
    place(event) {
      const r = this.svg.getBoundingClientRect();
      return {x: (event.clientX - r.left) * this.box.width / r.width, y: (event.clientY - r.top) * this.box.height / r.height};
    }

    listen() {
      const p = this.picture;
      p.addEventListener('pointerdown', (e) => this.dragBegins(e));
      p.addEventListener('pointermove', (e) => (this.drag ? this.dragMoves(e) : this.read(this.place(e))));
      p.addEventListener('pointerup', (e) => this.dragEnds(e));
      p.addEventListener('pointercancel', () => this.dragStops());
      p.addEventListener('pointerleave', () => this.group.plots.forEach((q) => q.hideReadout()));
      p.addEventListener('dblclick', (e) => { if (!e.target.closest('button')) this.reset(); });
      p.addEventListener('wheel', (e) => {
        if (!e.ctrlKey && document.activeElement !== p) return;  // the page must stay scrollable
        e.preventDefault();
        this.zoomAt(this.fromX(this.place(e).x), Math.exp(clamp(e.deltaY, -120, 120) * 0.003));
      }, {passive: false});
      p.addEventListener('keydown', (e) => {
        const act = {ArrowLeft: () => this.pan(-0.2), ArrowRight: () => this.pan(0.2), '+': () => this.zoomAt((this.viewX[0] + this.viewX[1]) / 2, 0.7),
          '-': () => this.zoomAt((this.viewX[0] + this.viewX[1]) / 2, 1 / 0.7), 0: () => this.reset(), Escape: () => this.reset(),
          c: () => this.save()}[e.key];
        if (!act || e.ctrlKey || e.metaKey || e.altKey) return;
        e.preventDefault();
        act();
      });
      this.button.addEventListener('click', () => this.reset());
      this.figure.querySelectorAll('.legend li').forEach((item, i) => {
        const toggle = () => {
          this.curves[i].shown = !this.curves[i].shown;
          item.classList.toggle('off', !this.curves[i].shown);
          item.setAttribute('aria-pressed', String(this.curves[i].shown));
          this.draw();
        };
        item.tabIndex = 0;
        item.setAttribute('role', 'button');
        item.setAttribute('aria-pressed', 'true');
        item.addEventListener('click', toggle);
        item.addEventListener('keydown', (e) => { if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); toggle(); } });
      });
      new ResizeObserver(() => requestAnimationFrame(() => {
        if (p.clientWidth !== this.drawnFor) this.draw();
      })).observe(p);
    }

    dragBegins(e) {
      if (e.button !== 0 || e.pointerType === 'touch' || e.target.closest('button')) return;
      const at = this.place(e);
      this.drag = {from: at, pan: e.shiftKey, x: [...this.range.x], y: [...this.range.y], perX: this.fromX(1) - this.fromX(0), perY: this.fromY(1) - this.fromY(0)};
      this.picture.setPointerCapture(e.pointerId);
      this.hideReadout();
      if (e.shiftKey) e.preventDefault();  // no text selection
    }

    dragMoves(e) {
      const at = this.place(e), d = this.drag;
      if (d.pan) {
        const dx = (d.from.x - at.x) * d.perX, dy = (d.from.y - at.y) * d.perY;
        if (this.group.viewX) this.setX(d.x[0] + dx, d.x[1] + dx);
        if (this.viewY || Math.abs(at.y - d.from.y) > 12) this.viewY = [d.y[0] + dy, d.y[1] + dy];
        this.redrawGroup();
        return;
      }
      const r = this.selected(at);
      if (!r) { this.selection.setAttribute('visibility', 'hidden'); return; }
      for (const [key, value] of Object.entries({x: r.x0, y: r.y0, width: r.x1 - r.x0, height: r.y1 - r.y0, visibility: 'visible'}))
        this.selection.setAttribute(key, value);
    }

    /** The rectangle between where the drag began and `at`; a flat one spans all of y, an upright one all of x. */
    selected(at) {
      const {left, right, top, bottom} = this.box, d = this.drag;
      const dx = Math.abs(at.x - d.from.x), dy = Math.abs(at.y - d.from.y);
      if (dx < 6 && dy < 6) return null;
      const r = {x0: clamp(Math.min(at.x, d.from.x), left, right), x1: clamp(Math.max(at.x, d.from.x), left, right),
        y0: clamp(Math.min(at.y, d.from.y), top, bottom), y1: clamp(Math.max(at.y, d.from.y), top, bottom), flat: dy < 14, upright: dx < 14 && dy >= 14};
      if (r.flat) { r.y0 = top; r.y1 = bottom; }
      if (r.upright) { r.x0 = left; r.x1 = right; }
      return r;
    }

    dragEnds(e) {
      const d = this.drag;
      if (!d) return;
      const r = d.pan ? null : this.selected(this.place(e));
      if (r) {
        const x = [this.fromX(r.x0), this.fromX(r.x1)], y = [this.fromY(r.y1), this.fromY(r.y0)];
        if (!r.upright && r.x1 > r.x0) this.setX(...x);
        if (!r.flat && r.y1 > r.y0) this.viewY = y;
      }
      this.dragStops();
      this.redrawGroup();
    }

    dragStops() {
      this.drag = null;
      this.selection.setAttribute('visibility', 'hidden');
    }

    // -- reading values

    hideReadout() {
      this.readout.hidden = true;
      this.cursor.setAttribute('visibility', 'hidden');
      this.dots.replaceChildren();
    }

    /** The point of a curve that the pointer means: the nearest in x over time, the nearest on the screen in a loop. */
    nearest(c, at) {
      if (c.monotone) {
        const x = this.fromX(at.x);
        const k = lowerBound(c.x, x);
        const candidates = [k - 1, k].filter((i) => i >= 0 && i < c.x.length && Number.isFinite(c.y[i]));
        candidates.sort((a, b) => Math.abs(c.x[a] - x) - Math.abs(c.x[b] - x));
        return candidates.length ? {i: candidates[0], distance: 0} : null;
      }
      let best = null;
      for (let i = 0; i < c.x.length; ++i) {
        const distance = Math.hypot(this.atX(c.x[i]) - at.x, this.atY(c.y[i]) - at.y);
        if (distance < (best ? best.distance : 40)) best = {i, distance};
      }
      return best;
    }

    read(at) {
      const {left, right, top, bottom} = this.box;
      const inside = at.x >= left && at.x <= right && at.y >= top && at.y <= bottom;
      for (const p of this.group.plots) p.hideReadout();
      if (!inside) return;
      let points = this.curves.filter((c) => c.shown).map((c) => ({c, ...this.nearest(c, at)})).filter((q) => q.i !== undefined);
      if (points.some((q) => !q.c.monotone)) points = points.sort((a, b) => a.distance - b.distance).slice(0, 1);
      if (!points.length) return;
      const closest = points.reduce((a, b) => (Math.abs(a.c.x[a.i] - this.fromX(at.x)) <= Math.abs(b.c.x[b.i] - this.fromX(at.x)) ? a : b));
      this.showReadout(points, closest, at);
      if (closest.c.monotone) for (const p of this.group.plots) p.showCursor(closest.c.x[closest.i]);
    }

    showCursor(x) {
      const at = px(this.atX(x));
      for (const [key, value] of Object.entries({x1: at, x2: at, y1: this.box.top, y2: this.box.bottom, visibility: 'visible'}))
        this.cursor.setAttribute(key, value);
    }

    showReadout(points, closest, at) {
      const value = (v, log, range) => (log ? valueText(10 ** v, 10 ** v) : valueText(v, range[1] - range[0]));
      const unitX = bracket(this.data.x_label), unitY = bracket(this.data.y_label);
      const table = document.createElement('table');
      const row = (css, ...cells) => {
        const tr = table.insertRow();
        tr.className = css;
        for (const text of cells) tr.insertCell().textContent = text;
      };
      row('head', '', bare(this.data.x_label) || 'x', `${value(closest.c.x[closest.i], this.data.log_x, this.range.x)} ${unitX}`.trim());
      for (const {c, i} of points) {
        row('c-' + c.colour, '●', c.name || bare(this.data.y_label), `${value(c.y[i], this.data.log_y, this.range.y)} ${unitY}`.trim());
        make('circle', {class: `dot c-${c.colour}`, cx: px(this.atX(c.x[i])), cy: px(this.atY(c.y[i])), r: 4}, this.dots);
      }
      this.readout.replaceChildren(table);
      this.readout.hidden = false;
      const scale = this.picture.clientWidth / this.box.width, gap = 16;
      const w = this.readout.offsetWidth, h = this.readout.offsetHeight;
      const x = at.x * scale + gap + w > this.picture.clientWidth ? at.x * scale - gap - w : at.x * scale + gap;
      this.readout.style.left = `${Math.max(0, x)}px`;
      this.readout.style.top = `${clamp(at.y * scale - h / 2, 0, this.picture.clientHeight - h)}px`;
    }
  }
  Plot.count = 0;

  // ---- the page --------------------------------------------------------------------------------------------------

  const plots = [];
  for (const figure of document.querySelectorAll('.figure')) {
    const json = figure.querySelector('script[type="application/json"]');
    try {
      if (json) plots.push(new Plot(figure, JSON.parse(json.textContent)));
      else figure.dataset.drawn = 'true';
    } catch (error) {
      failed();
      console.error(error);
    }
  }
  for (const plot of plots) plot.draw();
  addEventListener('beforeprint', () => document.querySelectorAll('details').forEach((d) => { d.open = true; }));
  body.classList.add('live');
})();
