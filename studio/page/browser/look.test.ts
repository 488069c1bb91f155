// People's ways through the first part: open, run, compare, see where it fails, try what is missing.

import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {Studio} from './studio';

describe('looking', () => {
  const studio = new Studio();
  beforeAll(async () => {
    studio.copy('docs/loop.json', 'loop.json');
    studio.copy('diagrams/discover/demo', 'demo');
    await studio.serve();
    await studio.open();
  });
  afterAll(() => studio.close());

  it('draws the diagram with its units, and runs it to the same bits as the command line', async () => {
    const {page} = studio;
    await studio.openDiagram('loop.json');
    expect(await page.locator('.react-flow__node').count()).toBe(11);  // ten blocks and the output
    expect(await page.locator('.react-flow__edge').count()).toBe(12);
    expect(await studio.block('controller').locator('text.unit').allTextContents()).toEqual(['V']);
    await studio.verb('Run');
    await page.waitForSelector('.plot canvas');
    const job = JSON.parse(await page.evaluate(async (token) =>
      (await fetch('/api/state', {headers: {Authorization: `Bearer ${token}`}})).text(), studio.token)).jobs[0];
    expect(studio.hysteron('run', 'loop.json', '--traces', 'f64', '-o', 'out').code).toBe(0);
    expect(readFileSync(join(studio.folder, job.folder, 'traces/signals.f64')).equals(readFileSync(join(studio.folder, 'out/traces/signals.f64')))).toBe(true);
  });

  it('shows last values and values with units in the inspector', async () => {
    const {page} = studio;
    await studio.block('position').click();
    expect(await page.textContent('.inspector')).toContain('last 1.239 um');
    await studio.block('hysteresis').click();
    await page.waitForSelector('.inspector input[aria-label="alpha"]');
    expect(await page.inputValue('.inspector input[aria-label="alpha"]')).toBe('0.6187 um/V');
  });

  it('compares, and shades the spans of a bar over the curves', async () => {
    const {page} = studio;
    await studio.openDiagram('demo/stage.json');
    await studio.verb('Compare');
    await page.waitForSelector('.bar-row');
    await page.selectOption('[aria-label="split by"]', 'hold_time of y');
    await page.selectOption('.panel-head [aria-label="recording"]', '05.csv');
    await page.waitForTimeout(800);
    const picture = () => page.locator('.plot canvas').first().evaluate((c) => (c as HTMLCanvasElement).toDataURL());
    const before = await picture();
    await page.click('.bar-row:has-text("above 10 s")');
    await studio.until(async () => (await picture()) !== before);
    expect(await page.locator('.panel-head [aria-label="recording"]').inputValue()).toBe('05.csv');
    await page.click('button:text-is("All signals along 05.csv")');
    await page.waitForSelector('.signals label[title="u"]', {timeout: 60000});  // which the diagram does not record
    expect(await page.locator('.panel-head [aria-label="recording"]').inputValue()).toBe('05.csv');
  });

  it('finds creep, shows it, writes it when it is accepted, and takes it back', async () => {
    const {page} = studio;
    const original = studio.read('demo/stage.json');
    await studio.verb('Discover');
    await page.waitForSelector('.card', {timeout: 300000});
    expect(await page.textContent('.card header')).toMatch(/creep at stack61\.22 nm → 0\.23\d* nm/);  // the noise is 0.238 nm
    await page.click('.card button:text-is("Try")');
    await page.waitForSelector('.block.new');
    expect(studio.read('demo/stage.json')).toBe(original);
    await page.click('.card button:text-is("Accept")');
    await studio.until(() => studio.read('demo/stage.json') !== original);
    expect(JSON.parse(studio.read('demo/stage.json')).blocks.stack_creep.effect).toBe('creep');
    await studio.tab('Waterfall');
    expect(await page.locator('.waterfall text.value').allTextContents()).toEqual(['61.22 nm', expect.stringMatching(/^0\.23\d* nm$/)]);
    await studio.verb('Compare');
    await page.waitForSelector('.panel-head .headline:has-text("misses y by 0.23")');
    await page.click('[aria-label="undo"]');
    await studio.until(() => studio.read('demo/stage.json') === original);
    await page.click('.menu > button');
    await page.waitForSelector('.job:has-text("of an earlier version")');  // what was compared is not what lies there now
    await page.click('.shade');
  });

  it('opens a report once, and runs no script of it in the name of the studio', async () => {
    const {page} = studio;
    await page.click('.menu > button');
    const [report] = await Promise.all([page.context().waitForEvent('page'), page.click('.job button:text-is("report") >> nth=0')]);
    await report.waitForSelector('h1, h2');
    const again = await page.evaluate(async (url) => (await fetch(url)).status, report.url());
    expect(again).toBe(404);
    await report.close();
    await page.click('.shade');
  });

  it('leaves nothing behind of diagrams and texts that are looked at again and again', async () => {
    const {page} = studio;
    const client = await page.context().newCDPSession(page);
    await client.send('Performance.enable');
    const nodes = async () => {
      await client.send('HeapProfiler.collectGarbage');
      const {metrics} = await client.send('Performance.getMetrics');
      return metrics.find((m) => m.name === 'Nodes')!.value;
    };
    const round = async () => {
      for (const file of ['loop.json', 'demo/stage.json']) await studio.openDiagram(file);
      await studio.tab('Text');
      await page.locator('.text-view .cm-content').waitFor();
      await studio.tab('Scopes');
      await page.locator('.text-view').waitFor({state: 'detached'});
    };
    for (let i = 0; i < 3; ++i) await round();
    const before = await nodes();
    for (let i = 0; i < 6; ++i) await round();
    // A text alone is more than 200 nodes: six that stayed would be 1200. Which round is still being forgotten differs.
    expect((await nodes()) - before).toBeLessThan(600);
  });

  it('leaves no complaint on the console that is not about the report that opens once, and asks no other host', () => {
    expect(studio.complaints.filter((c) => !c.includes('404'))).toEqual([]);
  });
});
