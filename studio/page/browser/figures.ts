// Measures what the studio costs, and prints a line per figure: figures.ts FOLDER [MINUTES of random use, 5].
// On a quiet machine: every time here is wall-clock time.

import {readFileSync} from 'node:fs';
import {axis, flat, nested} from './large';
import {diagramOf, drive, Studio} from './studio';

const minutes = Number(process.argv[3] ?? 5);
const tell = (what: string, value: string) => console.log(`${what.padEnd(58)} ${value}`);
const median = (values: number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const ms = (value: number) => `${value.toFixed(0)} ms`;
const kB = (bytes: number) => `${(bytes / 1000).toFixed(1)} kB`;

const studio = new Studio();
studio.write('large/axis.json', axis);
studio.write('large/machine.json', nested(20));
studio.write('large/flat.json', flat(100));
studio.write('long.json', diagramOf([drive, '"behind": {"type": "lag", "times": ["10 ms"], "in": "drive"}'], ['drive', 'behind']).replace('"1 s", "every": "1 ms"', '"10 s", "every": "1 us"'));
studio.copy('diagrams/discover/demo', 'demo');
studio.copy('docs/loop.json', 'loop.json');
await studio.serve();

/// Bytes of answers by their addresses.
const page = await studio.open();
const taken: {url: string; bytes: number; asked: number}[] = [];
page.on('response', async (r) => {
  try {
    taken.push({url: new URL(r.url()).pathname, bytes: (await r.body()).length, asked: r.request().postDataBuffer()?.length ?? 0});
  } catch {
    // an answer that goes on, or of a page that was left
  }
});
await page.reload();
await page.waitForSelector('.react-flow__node');
const paint = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? 0);
tell('page: studio.js, studio.css, index.html', kB(taken.filter((t) => /^\/$|\.(js|css|svg)$/.test(t.url)).reduce((sum, t) => sum + t.bytes, 0)));
tell('first paint', ms(paint));

/// Frames while `act` is going on: the median time of one.
async function frames(act: () => Promise<void>): Promise<number> {
  await page.evaluate(() => {
    const seen: number[] = ((window as any).seen = []);
    const next = (t: number) => {
      seen.push(t);
      (window as any).ticking = requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  });
  await act();
  const times: number[] = await page.evaluate(() => (cancelAnimationFrame((window as any).ticking), (window as any).seen));
  return median(times.slice(1).map((t, i) => t - times[i]));
}

const select = (block: string) => page.evaluate((name) => (document.querySelector(`.react-flow__node[data-id="${name}"]`) as HTMLElement).dispatchEvent(new MouseEvent('click', {bubbles: true})), block);
const drawn = () => page.evaluate(() => new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r))));

/// From what is done until the answer to it is drawn.
async function answered(request: string, act: () => Promise<void>): Promise<number> {
  const begin = performance.now();
  await Promise.all([page.waitForResponse((r) => r.url().includes(request)), act()]);
  await drawn();
  return performance.now() - begin;
}

/// From a key until what it changed on the canvas is drawn, on the clock of the page: without the way of tests to it.
async function drawnAfter(press: () => Promise<void>): Promise<number> {
  await page.evaluate(() => {
    (window as any).drawn = new Promise((tell) => addEventListener('keydown', (key) => {
      const changed = new MutationObserver(() => {
        changed.disconnect();
        requestAnimationFrame(() => requestAnimationFrame(() => tell(performance.now() - key.timeStamp)));
      });
      changed.observe(document.querySelector('.react-flow__viewport')!, {subtree: true, childList: true, characterData: true, attributes: true});
    }, {capture: true, once: true}));
  });
  await press();
  return page.evaluate(() => (window as any).drawn);
}

async function edit(block: string, field: string, values: string[]): Promise<{wait: number; bytes: number; asked: number}> {
  await select(block);
  const input = page.locator(`.inspector input[aria-label="${field}"]`);
  await input.waitFor();
  const waits: number[] = [];
  for (const value of values) {
    taken.length = 0;
    await input.fill(value);
    waits.push(await drawnAfter(() => input.press('Enter')));
    await page.waitForTimeout(500);
  }
  await studio.until(() => taken.some((t) => t.url === '/api/edit'));
  const last = taken.find((t) => t.url === '/api/edit')!;
  return {wait: median(waits), bytes: last.bytes, asked: last.asked};
}

async function pan(): Promise<void> {
  const box = (await page.locator('.react-flow__pane').boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  for (let i = 0; i < 40; ++i) await page.mouse.wheel(i % 20 < 10 ? 30 : -30, 8 * ((i % 2) * 2 - 1));
}

await studio.openDiagram('demo/stage.json');
const small = await edit('capacitive_sensor', 'gain', ['1.1', '1.2', '1.3', '1.4', '1']);
tell('an edit of the demonstration: sent, answered, drawn', `${small.asked} B, ${kB(small.bytes)}, ${ms(small.wait)}`);

for (const [file, block, one] of [['large/machine.json', 'move', 'axis_1'], ['large/flat.json', 'move', 'table_1']]) {
  await page.click('.sidebar button:text-is("Files")');
  const begin = performance.now();
  await page.click(`.entry.file[data-path="${file}"]`);
  await page.waitForSelector(`.react-flow__node[data-id="${one}"]`, {state: 'attached'});
  tell(`${file}: opened`, ms(performance.now() - begin));
  await page.waitForTimeout(500);
  const large = await edit(block, 'amplitude', ['21 mm', '22 mm', '23 mm', '20 mm']);
  tell(`${file}: an edit: sent, answered, drawn`, `${large.asked} B, ${kB(large.bytes)}, ${ms(large.wait)}`);
  await select(one);
  await page.locator('.canvas').focus();
  const removed = await drawnAfter(() => page.keyboard.press('Delete'));
  await page.waitForTimeout(500);
  tell(`${file}: a block removed, and brought back`, `${ms(removed)}, ${ms(await drawnAfter(() => page.keyboard.press('Control+z')))}`);
  tell(`${file}: a frame while it is panned, all in view`, ms(await frames(pan)));
  for (let i = 0; i < 5; ++i) await page.click('.react-flow__controls-zoomin');
  await page.waitForTimeout(500);
  const inView = await page.locator('.react-flow__node').count();
  tell(`${file}: a frame while it is panned, ${inView} in view`, ms(await frames(pan)));
  const node = page.locator('.react-flow__node:visible').first();
  const box = (await node.boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  tell(`${file}: a frame while a block is dragged`, ms(await frames(async () => {
    for (let i = 0; i < 40; ++i) await page.mouse.move(box.x + box.width / 2 + 2 * i, box.y + box.height / 2 + i);
  })));
  await page.mouse.up();
  await page.waitForTimeout(500);
}

await studio.openDiagram('long.json');
await studio.verb('Run');
await page.locator('.plot canvas').first().waitFor();
const plot = (await page.locator('.plot .u-over').first().boundingBox())!;
const zooms: number[] = [];
for (let i = 0; i < 7; ++i) {
  await page.mouse.move(plot.x + 0.2 * plot.width, plot.y + plot.height / 2);
  await page.mouse.down();
  await page.mouse.move(plot.x + 0.7 * plot.width, plot.y + plot.height / 2, {steps: 3});
  zooms.push(await answered('/api/trace', () => page.mouse.up()));
}
const out = await answered('/api/trace', () => page.mouse.dblclick(plot.x + plot.width / 2, plot.y + plot.height / 2));
tell('10^7 rows: zoomed in, seven times by two; all of it again', `median ${ms(median(zooms))}, largest ${ms(Math.max(...zooms))}; ${ms(out)}`);

// Random use: edits, undos, runs, tabs, zoom; the same each time.
const files = ['demo/stage.json', 'loop.json', 'large/machine.json'];
const client = await page.context().newCDPSession(page);
async function memory(): Promise<string> {
  await studio.openDiagram(files[0]);  // each time the same is looked at: what is more is kept by somebody
  await page.locator('.results .tabs button').first().click();
  await page.waitForTimeout(1000);
  for (let i = 0; i < 3; ++i) await client.send('HeapProfiler.collectGarbage');
  const {metrics} = (await client.send('Performance.getMetrics')) as {metrics: {name: string; value: number}[]};
  const of = (name: string) => metrics.find((m) => m.name === name)?.value ?? 0;
  const server = Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${studio.pid}/status`, 'utf8'))![1]);
  return `server ${(server / 1000).toFixed(0)} MB, page ${(of('JSHeapUsedSize') / 1e6).toFixed(1)} MB of scripts, ${of('Nodes')} nodes`;
}
await client.send('Performance.enable');
let state = 7;
const random = (below: number) => (state = (state * 1103515245 + 12345) % 2147483648) % below;
tell('memory before', await memory());
let done = 0;
let half = Date.now() + 30000 * minutes;
for (const end = Date.now() + 60000 * minutes; Date.now() < end; ++done) {
  if (Date.now() > half) {
    half = end;
    tell(`memory after ${done} actions`, await memory());
  }
  const tabs = page.locator('.results .tabs button');
  switch (random(8)) {
    case 0: await studio.openDiagram(files[random(files.length)]); break;
    case 1: await tabs.nth(random(8)).click(); break;
    case 2: await page.keyboard.press('Escape'); await studio.verb('Run'); break;
    case 3: if (await page.isEnabled('[aria-label="undo"]')) await page.click('[aria-label="undo"]'); break;
    case 4: if (await page.isEnabled('[aria-label="redo"]')) await page.click('[aria-label="redo"]'); break;
    case 5: await page.click('.fit-all'); await page.mouse.wheel(0, 40); break;
    case 6: await page.click('[aria-label="dark or light"]'); break;
    default: {
      const nodes = page.locator('.react-flow__node');
      await nodes.nth(random(await nodes.count())).focus();
      await page.keyboard.press('Enter');
      const input = page.locator('.inspector .row input.field').first();
      if (await input.count()) await input.press('ArrowUp'), await input.press('Enter');
    }
  }
}
tell(`memory after ${minutes} min of random use, ${done} actions`, await memory());
tell('complaints of the page', String(studio.complaints.length));
for (const complaint of studio.complaints.slice(0, 5)) console.log(`  ${complaint}`);
const ticks = () => readFileSync(`/proc/${studio.pid}/stat`, 'utf8').split(' ').slice(13, 15).reduce((a, b) => a + Number(b), 0);
const before = ticks();
await page.waitForTimeout(10000);
tell('server while nobody does anything, one page open', `${(ticks() - before) / 10} % of a core`);
await studio.close();
