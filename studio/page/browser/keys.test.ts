// The keyboard alone, and eyes: every button is reached and seen to be, a block is placed, wired and set; contrast.

import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {unwired as small, Studio} from './studio';

describe('keys and eyes', () => {
  const studio = new Studio();
  beforeAll(async () => {
    await studio.openOn({'small.json': small, 'broken.json': small.replace('"5 Hz"', '"5 mm"').replace('"saturation"', '"no_such_block"')});
  });
  afterAll(() => studio.close());
  const text = () => studio.read('small.json');
  const press = (...keys: string[]) => keys.reduce((before, key) => before.then(() => studio.page.keyboard.press(key)), Promise.resolve());
  const focused = () => studio.page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? '');
  /// Presses Tab until this has the focus.
  const tabTo = async (name: string) => {
    for (let i = 0; i < 300; ++i) {
      if ((await focused()) === name) return;
      await press('Tab');
    }
    throw new Error(`Tab does not lead to "${name}"`);
  };

  it('reach every button of the bar and every tab by Tab, each with a mark that is seen', async () => {
    const {page} = studio;
    await page.evaluate(() => (document.activeElement as HTMLElement)?.blur());
    const wanted = await page.$$eval('.topbar button:enabled, .topbar select, .tabs button', (all) => all.map((e) => e.getAttribute('aria-label') ?? e.textContent));
    const seen = new Set<string>();
    for (let i = 0; i < 300 && wanted.some((name) => !seen.has(name!)); ++i) {
      await press('Tab');
      const marked = await page.evaluate(() => {
        const style = getComputedStyle(document.activeElement!);
        return style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2;
      });
      if (marked) seen.add(await focused());
    }
    expect(wanted.filter((name) => !seen.has(name!))).toEqual([]);
  });

  it('wire an input from the list of signals, and refuse another unit in the words of check', async () => {
    const {page} = studio;
    await tabTo('limit, saturation');
    await press('Enter');
    await page.waitForSelector('.inspector [aria-label="wire of u"]');
    await tabTo('wire of u');
    await page.keyboard.type('force');
    await page.waitForSelector('.banner.error');
    expect(text()).toBe(small);
    await page.waitForTimeout(1500);  // a list of choices takes letters that follow each other for one word
    await tabTo('wire of u');
    await page.keyboard.type('drive');
    await studio.until(() => text() === small.replace('"upper": "10 V"}', '"upper": "10 V", "in": "drive"}'));
  });

  it('place a block, set its value with a unit, record it, and take all of it back', async () => {
    const {page} = studio;
    const wired = text();
    await tabTo('limit, saturation');
    await press('/');
    await page.keyboard.type('gain');
    await press('Enter');
    await studio.until(() => text() !== wired);
    await studio.until(async () => (await page.inputValue('.inspector header input')) === 'gain');
    await tabTo('gain');
    await press('Control+a');
    await page.keyboard.type('3 um/V');
    await press('Enter');
    await studio.until(() => text().includes('"gain": {"type": "gain", "gain": "3 um/V", "in": "limit"}'));
    await tabTo('record gain');
    await press('Space');
    await studio.until(() => text().includes('"limit", "gain"]'));
    await tabTo('limit, saturation');
    for (let i = 0; i < 4; ++i) {
      const now = text();
      await press('Control+z');
      await studio.until(() => text() !== now);
    }
    expect(text()).toBe(small);
  });

  it('complete words and signals in the text', async () => {
    const {page} = studio;
    await studio.tab('Text');
    const field = page.locator('.text-view .cm-content');
    await field.waitFor();
    await page.locator('.text-view .cm-line:has-text("10 V")').click();
    await press('End', 'ArrowLeft');
    await page.keyboard.type(', "in": "dri');
    await page.waitForSelector('.text-view .cm-tooltip-autocomplete li:has-text("drive")');
    await page.waitForTimeout(200);  // the editor takes no key within its first moments as an answer
    await press('Enter', 'Control+s');
    await studio.until(() => text() === small.replace('"upper": "10 V"}', '"upper": "10 V", "in": "drive"}'));
    await page.click('[aria-label="undo"]');
    await studio.until(() => text() === small);
  });

  /// WCAG 2.1, 1.4.3: (lighter + 0.05)/(darker + 0.05) of the relative luminances is at least 4.5 for text of these sizes.
  it('read every text at a contrast of 4.5 at least, dark and light', async () => {
    const {page} = studio;
    const weak = () => page.evaluate(() => {
      const parts = (colour: string) => {
        const [r, g, b, a = 1] = colour.match(/[\d.]+/g)!.map(Number);
        return [r, g, b, a];
      };
      const over = (top: number[], below: number[]) => [0, 1, 2].map((i) => top[i] * top[3] + below[i] * (1 - top[3])).concat(1);
      const ground = (e: Element | null): number[] => {
        if (!e) return [255, 255, 255, 1];
        const here = parts(getComputedStyle(e).backgroundColor);
        return here[3] === 1 ? here : over(here, ground(e.parentElement));
      };
      const light = (c: number[]) => {
        const [r, g, b] = c.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : Math.pow((v / 255 + 0.055) / 1.055, 2.4)));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const found: string[] = [];
      for (const e of document.querySelectorAll('body *')) {
        const own = [...e.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent!.trim());
        if (!own || !e.checkVisibility() || e.closest(':disabled, script, style, option')) continue;
        const style = getComputedStyle(e);
        const below = ground(e);
        const [a, b] = [light(over(parts(e instanceof SVGElement ? style.fill : style.color), below)), light(below)];
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        if (ratio < 4.5) found.push(`${e.textContent!.trim().slice(0, 30)} (${e.className instanceof SVGAnimatedString ? e.className.baseVal : e.className}): ${ratio.toFixed(2)}`);
      }
      return [...new Set(found)];
    });
    for (const file of ['small.json', 'broken.json']) {
      await studio.openDiagram(file);
      await studio.block('drive').click();
      for (const theme of ['light', 'dark']) {
        await page.evaluate((t) => (document.documentElement.dataset.theme = t), theme);
        for (const tab of ['Scopes', 'Effects', 'Diff', 'Data', 'Problems']) {
          await page.click(`.results .tabs button:has-text("${tab}")`);
          await page.waitForTimeout(100);
          expect(await weak(), `${file}, ${theme}, ${tab}`).toEqual([]);
        }
      }
    }
  });

  it('leave no complaint', () => expect(studio.complaints).toEqual([]));
});
