// People's ways through the scopes: two cursors with what lies between, one signal over another, spectra, the theme.

import {readFileSync} from 'node:fs';
import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {diagramOf, drive, Studio} from './studio';

const small = diagramOf([drive, '"stage": {"type": "gain", "gain": "3 um/V", "in": "drive"}'], ['drive', 'stage']);

describe('scopes', () => {
  const studio = new Studio();
  beforeAll(async () => {
    await studio.openOn({'small.json': small});
    await studio.verb('Run');
    await studio.page.waitForSelector('.plot canvas');
  });
  afterAll(() => studio.close());
  const cells = (name: string) => studio.page.locator(`.signals li:has(.label:has-text("${name}")) .cell`).allTextContents();
  const readout = async () => ((await studio.page.textContent('.xy .hint')) ?? '').split(', ').map((part) => Number(part.split(' ')[0]));

  it('tell the values at two cursors, their difference and its inverse', async () => {
    const {page} = studio;
    await page.click('button:text-is("Cursors")');
    await studio.until(async () => (await cells('drive')).every(Boolean));
    for (const [cursor, at] of [['A', '0.05'], ['B', '0.15']]) {
      await page.fill(`[aria-label="cursor ${cursor}"]`, at);
      await page.press(`[aria-label="cursor ${cursor}"]`, 'Enter');
    }
    // The crest and the trough of 2 V sin(2 pi 5 Hz t).
    await studio.until(async () => JSON.stringify(await cells('drive')) === '["2","-2","-4"]');
    expect(await cells('stage')).toEqual(['6', '-6', '-12']);
    expect(await page.textContent('.signals .between')).toContain('10 Hz');
  });

  it('put the nearer cursor where one clicks', async () => {
    const {page} = studio;
    const box = (await page.locator('.plot .u-over').first().boundingBox())!;
    await page.mouse.click(box.x + 0.9 * box.width, box.y + 20);
    await studio.until(async () => Math.abs(Number(await page.inputValue('[aria-label="cursor B"]')) - 0.9) < 0.01);  // a pixel is 2 ms
    expect(Number(await page.inputValue('[aria-label="cursor A"]'))).toBeCloseTo(0.05, 9);
    await page.fill('[aria-label="cursor A"]', '0,05');
    await page.press('[aria-label="cursor A"]', 'Enter');
    await page.waitForSelector('.banner.error:has-text("with a decimal point")');
    await page.click('.banner.error button');
    await page.fill('[aria-label="cursor A"]', '0.07 s');
    await page.press('[aria-label="cursor A"]', 'Enter');
    await studio.until(async () => (await page.inputValue('[aria-label="cursor A"]')) === '0.07');
    await page.click('button:text-is("Cursors")');
    await page.waitForSelector('[aria-label="cursor A"]', {state: 'detached'});
  });

  it('are saved as CSV, row by row what run writes', async () => {
    const {page} = studio;
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('.signals button:text-is("save as CSV")')]);
    expect(download.suggestedFilename()).toBe('signals.csv');
    expect(studio.hysteron('run', 'small.json', '-o', 'out').code).toBe(0);
    const rows = (text: string) => text.trimEnd().split('\n').map((line, i) => (i === 0 ? line : line.split(',').map(Number)));
    expect(rows(readFileSync(await download.path(), 'utf8'))).toEqual(rows(studio.read('out/traces/signals.csv')));
  });

  it('draw one signal over another', async () => {
    const {page} = studio;
    await page.click('button:text-is("Loop")');
    await page.waitForSelector('svg[aria-label="stage over drive"] path[d^="M"]');
    await studio.until(async () => (await page.textContent('.xy .hint')) === '1001 rows');
    const box = (await page.locator('.xy svg').boundingBox())!;
    await page.mouse.move(box.x + 0.7 * box.width, box.y + 40);
    await studio.until(async () => (await readout()).length === 2);
    const [volts, micrometres] = await readout();
    expect(micrometres / volts).toBeCloseTo(3, 2);  // shown with five digits
    await page.selectOption('[aria-label="x of the loop"]', 't');
    await page.waitForSelector('svg[aria-label="stage over t"]');
  });

  it('show a sine in the spectrum at its frequency, as high as its amplitude', async () => {
    const {page} = studio;
    await page.click('button:text-is("Spectrum")');
    const svg = page.locator('.xy svg').first();
    await svg.locator('path[d^="M"]').waitFor();
    const peak = await svg.locator('path').first().evaluate((path) => {
      const points = path.getAttribute('d')!.slice(1).split('L').map((p) => p.split(' ').map(Number));
      return points.reduce((a, b) => (b[1] < a[1] ? b : a));
    });
    const box = (await svg.boundingBox())!;
    await page.mouse.move(box.x + peak[0], box.y + peak[1]);
    await studio.until(async () => (await page.textContent('.xy .hint'))!.includes('Hz, '));
    const [frequency, amplitude] = await readout();
    expect(Math.abs(frequency - 5)).toBeLessThan(0.25);  // a line of 1001 rows of 1 ms with zeros up to 4096 rows
    expect(Math.abs(amplitude - 2)).toBeLessThan(0.04);  // 1 % between lines, and leakage
    await page.click('button:text-is("Over time")');
    await page.waitForSelector('.plot canvas');
  });

  it('are drawn in the colours of the theme, also when it is changed', async () => {
    const {page} = studio;
    const before = await page.evaluate(() => document.documentElement.dataset.theme);
    // Greys in a row of pixels are those of the grid: dark lines on light are none.
    const greys = () => page.locator('.plot canvas').first().evaluate((element) => {
      const canvas = element as HTMLCanvasElement;
      const {data} = canvas.getContext('2d')!.getImageData(0, Math.round(canvas.height / 2), canvas.width, 1);
      const seen = new Set<number>();
      for (let i = 0; i < data.length; i += 4) if (data[i + 3] === 255 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) < 16) seen.add(data[i]);
      return [...seen];
    });
    for (const theme of ['light', 'dark', 'light']) {
      while ((await page.evaluate(() => document.documentElement.dataset.theme)) !== theme) await page.click('[aria-label="dark or light"]');
      await page.waitForTimeout(300);
      const seen = await greys();
      expect(seen.length).toBeGreaterThan(0);
      for (const grey of seen) theme === 'light' ? expect(grey).toBeGreaterThan(128) : expect(grey).toBeLessThan(128);
    }
    if (before === 'dark') await page.click('[aria-label="dark or light"]');
  });

  it('keep what is zoomed in when the theme is changed and changed back, to the pixel', async () => {
    const {page} = studio;
    const canvas = page.locator('.plot canvas').first();
    const picture = () => canvas.evaluate((element) => (element as HTMLCanvasElement).toDataURL());
    const resting = async () => {
      for (let last = '';;) {
        const now = await picture();
        if (now === last) return now;
        last = now;
        await page.waitForTimeout(300);
      }
    };
    const whole = await resting();
    const box = (await page.locator('.plot .u-over').first().boundingBox())!;
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.52 * box.width, box.y + 20, {steps: 4});
    await page.mouse.up();
    await page.waitForSelector('.signals button:text-is("show all")');
    const zoomed = await resting();
    expect(zoomed).not.toBe(whole);
    for (let i = 0; i < 2; ++i) await page.click('[aria-label="dark or light"]');
    expect(await resting()).toBe(zoomed);
    await page.click('.signals button:text-is("show all")');
    await studio.until(async () => (await resting()) === whole);
  });

  it('leave no complaint', () => expect(studio.complaints).toEqual([]));
});
