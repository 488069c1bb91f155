// People's ways through live curves: a number is dragged and the curves follow; two runs are laid over each other with a
// tolerance; candidates and diagrams are compared.

import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {diagramOf, drive, Studio} from './studio';

const small = diagramOf(
  [drive, '"stage": {"choose": "one", "from": {"one": {"type": "gain", "gain": "1 um/V"}, "two": {"type": "gain", "gain": "2 um/V"}}, "in": "drive"}'],
  ['drive', 'stage']);

describe('live', () => {
  const studio = new Studio();
  beforeAll(async () => {
    await studio.openOn({'small.json': small, 'other.json': small.replace('"5 Hz"', '"6 Hz"')});
  });
  afterAll(() => studio.close());
  const text = () => studio.read('small.json');

  it('follows a number that is dragged, and writes it when it is let go', async () => {
    const {page} = studio;
    await studio.verb('Run');
    await page.waitForSelector('.signals label:has-text("stage")');
    await studio.block('drive').click();
    const handle = page.locator('.inspector .handle:text-is("amplitude")');
    const box = (await handle.boundingBox())!;
    await page.mouse.move(box.x + 10, box.y + 8);
    await page.mouse.down();
    await page.mouse.move(box.x + 60, box.y + 8, {steps: 5});
    await page.waitForSelector('.signals .following:has-text("drive.amplitude = 2.5 V")');
    expect(await page.inputValue('.inspector input[aria-label="amplitude"]')).toBe('2.5 V');
    expect(text()).toBe(small);
    await page.mouse.move(box.x + 110, box.y + 8, {steps: 5});
    await page.waitForSelector('.signals .following:has-text("drive.amplitude = 3 V")');
    await page.mouse.up();
    await studio.until(() => text() === small.replace('"2 V"', '"3 V"'));
    await page.waitForSelector('.signals .following', {state: 'detached'});
    await studio.block('drive').click();
    await page.waitForSelector('.inspector .about:has-text("between -3 V and 3 V")');  // the run was made anew
    await page.locator('.canvas').press('Control+z');
    await studio.until(() => text() === small);
  });

  it('follows the arrow keys in a field, and Escape leaves everything as it was', async () => {
    const {page} = studio;
    await studio.block('stage').click();
    const field = page.locator('.inspector input[aria-label="gain"]');
    await field.focus();
    for (let i = 0; i < 3; ++i) await page.keyboard.press('ArrowUp');
    await page.waitForSelector('.signals .following:has-text("stage.gain = 1.03 um/V")');
    await page.keyboard.press('Escape');
    await page.waitForSelector('.signals .following', {state: 'detached'});
    expect(await field.inputValue()).toBe('1 um/V');
    expect(text()).toBe(small);
  });

  it('lays all candidates of a choice over each other by one click, and judges them by a tolerance', async () => {
    const {page} = studio;
    await studio.block('stage').click();
    await page.click('.inspector button:text-is("Compare all 2")');
    await page.waitForSelector('.signals .pinned:has-text("stage=two")');
    await page.fill('[aria-label="tolerance"]', '2.5 um');
    await page.press('[aria-label="tolerance"]', 'Enter');
    await page.waitForSelector('.headline:has-text("Within the tolerance: stage")');
    await page.fill('[aria-label="tolerance"]', '1 um');
    await page.press('[aria-label="tolerance"]', 'Enter');
    // |2 - 4| um |sin| > 1 um where |sin| > 1/2: two thirds of the time.
    const told = (await (await page.waitForSelector('.headline:has-text("lie outside")')).textContent())!;
    expect(Number(/^(\d+) of 1001/.exec(told)![1])).toBeCloseTo(1001 * 2 / 3, -1);
    await page.fill('[aria-label="tolerance"]', '1 blub');
    await page.press('[aria-label="tolerance"]', 'Enter');
    await page.waitForSelector('.tolerance-problem');
    await page.fill('[aria-label="tolerance"]', '');
    await page.press('[aria-label="tolerance"]', 'Enter');
    expect(text()).toBe(small);
  });

  it('tells in what another diagram differs, and runs both', async () => {
    const {page} = studio;
    await studio.tab('Diff');
    await page.selectOption('[aria-label="other diagram"]', 'other.json');
    await page.waitForSelector('.diff tbody tr');
    expect(await page.locator('.diff tbody tr').allTextContents()).toEqual(['drive frequency5 Hz6 Hz']);
    await page.locator('.diff tbody tr').hover();
    await page.waitForSelector('.block.highlighted');
    await page.click('button:text-is("Run both")');
    await page.waitForSelector('.signals .pinned');
  });

  it('leaves no complaint', () => expect(studio.complaints.filter((c) => !c.includes('400'))).toEqual([]));
});
