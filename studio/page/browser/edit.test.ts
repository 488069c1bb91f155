// People's ways through the second part: place, wire, set, undo, copy, and edits that come from elsewhere.

import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {diagramOf, drive, unwired as small, Studio} from './studio';

const withEffect = diagramOf([drive, '"soft": {"in": "drive", "effect": "soft_limit", "choose": "on", "from": {"on": {"type": "gain", "gain": 2}, "off": {"type": "gain", "gain": 1}}}'], ['soft']);

describe('editing', () => {
  const studio = new Studio();
  beforeAll(async () => {
    await studio.openOn({'small.json': small, 'effect.json': withEffect});
  });
  afterAll(() => studio.close());
  const text = () => studio.read('small.json');
  const textField = '.text-view .cm-content';
  const typed = () => studio.page.locator(textField).evaluate((e) => [...e.querySelectorAll('.cm-line')].map((l) => l.textContent).join('\n'));
  /// The field shows what the file holds: an undo is in the file before it is in the page, and what is typed in between
  /// would be typed into the text before.
  const shown = () => studio.until(async () => (await typed()) === text());
  const back = async () => {
    while (text() !== small) {
      const now = text();
      await studio.page.click('[aria-label="undo"]');
      await studio.until(() => text() !== now);
    }
    await studio.until(async () => (await studio.page.locator('.react-flow__edge').count()) === 0);
  };

  it('marks what is not wired, and refuses a wire of another unit in the words of check', async () => {
    const {page} = studio;
    expect(await studio.block('limit').locator('.port-in.free').count()).toBe(1);
    await studio.wire('force', 'limit');
    await page.waitForSelector('.banner.error');
    const told = (await page.textContent('.banner.error'))!;
    expect(text()).toBe(small);
    studio.write('wrong.json', small.replace('"upper": "10 V"', '"upper": "10 V", "in": "force"'));
    const check = studio.hysteron('check', 'wrong.json', '--json');
    expect(told).toContain(JSON.parse(check.err).problems[0].what);
    await page.click('.banner.error button');
  });

  const view = () => studio.page.locator('.react-flow__viewport').evaluate((e) => (e as HTMLElement).style.transform);
  const placed = (name: string) => studio.block(name).evaluate((e) => (e as HTMLElement).style.transform.match(/-?[\d.]+/g)!.map(Number));
  const layout = 'small.layout.json';
  const layoutOf = (x: number, y: number) => `{\n  "format": 1,\n  "blocks": {\n    "force": [${Math.round(x / 4)}, ${Math.round(y / 4)}]\n  }\n}\n`;

  it('moves a block by a drag: it stays at the mouse also where the hand rests, and is put in one step', async () => {
    const {page} = studio;
    const [seen, before] = [await view(), await placed('force')];
    const zoom = Number(/scale\(([\d.]+)\)/.exec(seen)![1]);
    const box = (await studio.block('force').boundingBox())!;
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (const far of [10, 60]) {
      await page.mouse.move(x + far, y + far / 2, {steps: 4});
      await page.waitForTimeout(700);  // longer than arrow keys rest before what they moved is put
      expect(studio.has(layout)).toBe(false);
      const now = await placed('force');
      // The grid is 4 px; the hand is at the mouse but for the 3 px before a press becomes a drag.
      for (const i of [0, 1]) expect(Math.abs(now[i] - before[i] - far / (i + 1) / zoom)).toBeLessThan(4 + 3 / zoom);
    }
    const there = await placed('force');
    await page.mouse.up();
    await studio.until(() => studio.has(layout));
    expect(studio.read(layout)).toBe(layoutOf(there[0], there[1]));
    await page.waitForSelector('[aria-label="lay out anew"]');
    expect(await placed('force')).toEqual(there);
    expect(await view()).toBe(seen);
    expect(text()).toBe(small);
    await page.click('[aria-label="undo"]');
    await page.waitForSelector('[aria-label="lay out anew"]', {state: 'detached'});
    expect(await placed('force')).toEqual(before);
  });

  it('moves a block by the arrow keys, in one step when they rest', async () => {
    const {page} = studio;
    const [seen, before] = [await view(), await placed('force')];
    await studio.block('force').click();
    await studio.block('force').focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowRight');
    const there = await placed('force');
    expect(there[0]).toBeGreaterThan(before[0] + 16);  // five steps of the grid of 4 px, the first of them onto it
    await page.waitForSelector('[aria-label="lay out anew"]');
    expect(studio.read(layout)).toBe(layoutOf(there[0], there[1]));
    expect(await placed('force')).toEqual(there.map((v) => 4 * Math.round(v / 4)));
    await page.click('[aria-label="undo"]');
    await page.waitForSelector('[aria-label="lay out anew"]', {state: 'detached'});
    expect(await placed('force')).toEqual(before);
    expect(await view()).toBe(seen);
  });

  it('wires by a drag: one line of the file changes', async () => {
    await studio.wire('drive', 'limit');
    await studio.until(() => text() !== small);
    expect(text()).toBe(small.replace('"upper": "10 V"}', '"upper": "10 V", "in": "drive"}'));
    await studio.until(async () => (await studio.page.locator('.react-flow__edge').count()) === 1);
    await back();
  });

  it('adds a block by the keyboard alone, sets its value with a unit, and runs it', async () => {
    const {page} = studio;
    await studio.wire('drive', 'limit');
    await studio.until(() => text() !== small);
    const wired = text();
    await studio.block('drive').focus();
    await page.keyboard.press('Enter');
    await studio.until(async () => (await page.inputValue('.inspector header input')) === 'drive');
    await page.keyboard.press('/');
    await page.keyboard.type('gain');
    await page.keyboard.press('Enter');
    await studio.until(() => text() !== wired);
    await page.fill('.inspector input[aria-label="gain"]', '3 um/V');
    await page.press('.inspector input[aria-label="gain"]', 'Enter');
    const expected = wired.replace('"10 V", "in": "drive"}', '"10 V", "in": "drive"},\n    "gain": {"type": "gain", "gain": "3 um/V", "in": "drive"}');
    await studio.until(() => text() === expected);
    await page.click('.inspector .check input');
    await studio.until(() => text().includes('"record": ["drive", "force", "limit", "gain"]'));
    await page.keyboard.press('Control+Enter');
    await page.waitForSelector('.signals label:has-text("gain")');
    await back();
  });

  it('is told of an edit what differs, and draws nothing but that', async () => {
    const {page} = studio;
    await studio.block('drive').click();
    const input = page.locator('.inspector input[aria-label="amplitude"]');
    await input.fill('3 V');
    await page.evaluate(() => {
      const changed: string[] = ((window as any).changed = []);
      const see = (list: MutationRecord[]) => list.forEach((m) => changed.push((m.target.parentElement?.closest('.react-flow__node, .react-flow__edge') as HTMLElement)?.dataset.id ?? 'the canvas'));
      new MutationObserver(see).observe(document.querySelector('.react-flow__viewport')!, {subtree: true, childList: true, characterData: true, attributes: true});
    });
    const [reply] = await Promise.all([page.waitForResponse((r) => r.url().includes('/api/edit')), input.press('Enter')]);
    await page.locator('.react-flow__node[data-id="drive"] .line:has-text("3 V")').waitFor();
    const {view, patch} = await reply.json();
    expect(view).toBeUndefined();
    // The line of the text and the hash of it; what stands below the block, and what the mouse is told there.
    expect(patch.map((p: {path: string}) => p.path.replace(/\d+/g, 'N')).sort()).toEqual(['/hash', '/lines/N', '/sheet/items/N/caption/N', '/sheet/items/N/tip']);
    expect([...new Set(await page.evaluate(() => (window as any).changed))]).toEqual(['drive']);
    await back();
  });

  it('makes each edit of the text as it is in its turn, where a hand is quicker than the program', async () => {
    const {page} = studio;
    const before = studio.complaints.length;
    await page.route('**/api/edit', async (route) => {
      await new Promise((done) => setTimeout(done, 400));
      await route.continue();
    });
    await studio.block('drive').click();
    const amplitude = page.locator('.inspector input[aria-label="amplitude"]');
    await amplitude.fill('3 V');
    await amplitude.press('Enter');
    await studio.block('limit').click();
    // Until an edit has arrived a list shows what was, and a letter that follows chooses again.
    const wire = page.locator('.inspector [aria-label="wire of u"]');
    for (let i = 0; i < 3; ++i) await wire.selectOption('drive');
    const recorded = page.locator('.inspector [aria-label="record limit"]');
    for (let i = 0; i < 2; ++i) await recorded.click();
    const upper = page.locator('.inspector input[aria-label="upper"]');
    await upper.fill('5 V');
    await upper.press('Enter');
    const wanted = small.replace('"amplitude": "2 V"', '"amplitude": "3 V"').replace('"upper": "10 V"}', '"upper": "5 V", "in": "drive"}').replace(', "limit"]', ']');
    await studio.until(() => text() === wanted);
    await page.unroute('**/api/edit');
    expect(studio.complaints.slice(before)).toEqual([]);
    await back();
  });

  it('takes back 50 random edits to the byte, also after a reload', async () => {
    const {page} = studio;
    let state = 11;
    const random = (below: number) => (state = (state * 1103515245 + 12345) % 2147483648) % below;
    for (let i = 0; i < 50; ++i) {
      const before = text();
      const [block, field, values] = [['drive', 'amplitude', ['1 V', '2 V', '3 V', '40 mV']], ['limit', 'upper', ['5 V', '10 V', '12 V', '1 kV']], ['force', 'value', ['1 N', '2 N', '3 mN', '7 N']]][random(3)] as [string, string, string[]];
      await studio.block(block).click();
      const input = page.locator(`.inspector input[aria-label="${field}"]`);
      await input.waitFor();
      // The file is written a moment before it is shown: neither what it has nor what is still shown would be a change.
      const other = values.filter((v) => v !== JSON.parse(before).blocks[block][field]);
      const shown = await input.inputValue();
      const value = other.filter((v) => v !== shown)[random(2)];
      await input.fill(value);
      await input.press('Enter');
      await studio.until(() => text() !== before);
    }
    await page.reload();
    await page.waitForSelector('.react-flow__node');
    for (let i = 0; i < 50; ++i) {
      const now = text();
      await page.click('[aria-label="undo"]');
      await studio.until(() => text() !== now);
    }
    expect(text()).toBe(small);
    await studio.until(() => page.isDisabled('[aria-label="undo"]'));
  });

  it('copies and pastes JSON, removes by Delete', async () => {
    const {page} = studio;
    await studio.block('drive').click();
    await page.keyboard.press('Control+c');
    await studio.until(async () => (await page.evaluate(() => navigator.clipboard.readText())).includes('sine'));
    expect(JSON.parse(await page.evaluate(() => navigator.clipboard.readText()))).toEqual({drive: JSON.parse(small).blocks.drive});
    await page.keyboard.press('Control+v');
    await studio.until(() => text().includes('"drive_2"'));
    await studio.until(async () => (await page.inputValue('.inspector header input')) === 'drive_2');
    await page.keyboard.press('Delete');
    await studio.until(() => text() === small);
    await page.keyboard.press('Control+z');
    await studio.until(() => text().includes('"drive_2"'));
    await back();
  });

  it('follows edits from elsewhere, and undo goes on through them', async () => {
    const {page} = studio;
    studio.write('small.json', small.replace('"force"', '"push"'));
    await studio.block('push').waitFor();
    await page.locator('.canvas').press('Control+z');
    await studio.until(() => text() === small);
    await studio.block('force').waitFor();
  });

  it('asks whose text counts where both have changed it', async () => {
    const {page} = studio;
    await studio.tab('Text');
    const mine = small.replace('"Small"', '"Mine"');
    await shown();
    await page.fill(textField, mine);
    studio.write('small.json', small.replace('"Small"', '"Theirs"'));
    await page.waitForTimeout(1500);
    expect(await typed()).toBe(mine);
    await page.click('.panel-head button:text-is("Save")');
    await studio.until(() => text() === mine);  // it was followed: what is saved stands on theirs, and undo brings that back
    await page.locator('.canvas').press('Control+z');
    await studio.until(() => text().includes('"Theirs"'));
    await page.locator('.canvas').press('Control+z');
    await studio.until(() => text() === small);
  });

  it('shows both texts where both have changed it in the same moment, and writes the one that is chosen', async () => {
    const {page} = studio;
    await shown();
    const mine = small.replace('"Small"', '"Mine"');
    await page.fill(textField, mine);
    await page.route('**/api/file', async (route) => {
      studio.write('small.json', small.replace('"Small"', '"Theirs"'));
      await route.continue();
    }, {times: 1});
    await page.click('.panel-head button:text-is("Save")');
    await page.waitForSelector('.banner.error pre');
    expect(await page.locator('.banner.error pre').allTextContents()).toEqual(['  "title": "Theirs",', '  "title": "Mine",']);
    expect(text()).toContain('"Theirs"');
    await page.click('.banner.error button:text-is("Write mine over it")');
    await studio.until(() => text() === mine);
    await back();
  });

  it('draws on while the text is no JSON, and tells the line', async () => {
    const {page} = studio;
    await shown();
    await page.fill(textField, small.replace('"2 V",', '"2 V"'));
    await page.press(textField, 'Control+s');
    await page.waitForSelector('.text-view .cm-lint-marker-error');
    const wrong = await page.locator(textField).evaluate((e) => [...e.querySelectorAll('.cm-line')].findIndex((l) => l.querySelector('.cm-lintRange-error')));
    expect(wrong + 1).toBe(5);
    expect(await page.locator('.react-flow__node').count()).toBe(3);
    await back();
  });

  it('keeps what was typed and not saved while another tab is looked at', async () => {
    const {page} = studio;
    const mine = small.replace('"Small"', '"Draft"');
    await page.fill(textField, mine);
    await studio.tab('Scopes');
    await studio.tab('Text');
    await studio.until(async () => (await typed()) === mine);
    await page.click('.panel-head button:text-is("Revert")');
    expect(text()).toBe(small);
  });

  it('switches an effect off and on again at its block', async () => {
    const {page} = studio;
    await studio.openDiagram('effect.json');
    const badge = page.locator('[role="switch"][aria-label="effect of soft"]');
    for (const [before, now] of [['true', 'off'], ['false', 'on']]) {
      await studio.until(async () => (await badge.getAttribute('aria-checked')) === before);
      await badge.click();
      await studio.until(() => studio.read('effect.json') === withEffect.replace('"choose": "on"', `"choose": "${now}"`));
    }
  });

  it('leaves no complaint but that of the conflict', () => expect(studio.complaints.filter((c) => !c.includes('409'))).toEqual([]));
});
