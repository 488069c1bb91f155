// Takes pictures of each step, as a person would look at them: pictures.ts FOLDER. Dark and light, on a small and on a large
// screen, with the demonstration, a diagram of chapter 2, a nested diagram of 200 blocks and a broken one.

import {mkdirSync} from 'node:fs';
import {join, resolve} from 'node:path';
import type {Page} from 'playwright-core';
import {axis, nested} from './large';
import {diagramOf, drive, Studio} from './studio';

const folder = resolve(process.argv[2] ?? 'pictures');
const wanted = process.argv[3] ?? '';
const screens = [{width: 1280, height: 800}, {width: 1920, height: 1080}];
mkdirSync(folder, {recursive: true});

const broken = diagramOf(
  [drive.replace('5 Hz', '5 mm'), '"force": {"type": "constant", "value": "1 N"}', '"wrong": {"type": "no_such_block", "in": "drive"}',
   '"total": {"type": "sum", "in": ["drive", "force"]}', '"limit": {"type": "saturation", "lower": "0 V", "upper": "10 V"}'],
  ['drive', 'nowhere']);

const studio = new Studio();
studio.copy('diagrams/discover/demo', 'demo');
studio.copy('diagrams/chapter2', 'chapter2');
studio.copy('diagrams/parameters', 'parameters');
studio.copy('diagrams/motion', 'motion');
studio.write('hysteron.project', '');
studio.write('large/axis.json', axis);
studio.write('large/machine.json', nested(20));
studio.write('broken.json', broken);
studio.write('measured.csv', 'time;U in V;x in um\n' + Array.from({length: 2000}, (_, i) => `${(i / 1000).toFixed(3)};${Math.sin(i / 50).toFixed(4)};${(2 * Math.sin(i / 50 - 0.2)).toFixed(4)}`).join('\n') + '\n');
await studio.serve();
const page: Page = await studio.open();

/// What is on the page now, in both themes and on both screens.
async function picture(name: string): Promise<void> {
  if (wanted && !name.includes(wanted)) return;
  for (const theme of ['light', 'dark']) {
    await page.evaluate((t) => (document.documentElement.dataset.theme = t), theme);
    for (const screen of screens) {
      await page.setViewportSize(screen);
      await page.waitForTimeout(150);
      await page.locator('.fit-all').dispatchEvent('click');  // also below a menu
      await page.mouse.move(4, screen.height - 4);
      await page.waitForTimeout(350);
      await page.screenshot({path: join(folder, `${name}-${theme}-${screen.width}.png`)});
    }
  }
  await page.setViewportSize(screens[0]);
  console.log(name);
}
const {verb, tab} = studio;

await studio.openDiagram('chapter2/feedback_continuous.json');
await picture('1-chapter2-opened');
await verb('Run');
await page.waitForSelector('.plot canvas');
await studio.block('controller').click();
await picture('1-chapter2-run');

await studio.openDiagram('motion/ball_screw_cascade.json');
await verb('Run');
await page.waitForSelector('.plot canvas');
await picture('1-motion-run');

await studio.openDiagram('large/machine.json');
await picture('1-large-opened');
await studio.verb('Nested');
await page.waitForTimeout(1500);
await picture('1-large-nested');
await studio.verb('Nested');

await studio.openDiagram('broken.json');
await studio.block('total').click();
await page.click('.results .tabs button:has-text("Problems")');
await picture('2-broken');
await tab('Text');
await page.waitForSelector('.text-view .cm-content');
await page.waitForTimeout(500);
await picture('2-broken-text');

await studio.openDiagram('demo/stage.json');
await verb('Compare');
await page.waitForSelector('.bar-row');
await page.click('.bar-row >> nth=0');
await picture('1-demo-compare');
await tab('Scopes');
await page.waitForSelector('.plot canvas');
await picture('1-demo-scopes');
await studio.block('stack').click();
await page.keyboard.press('/');
await page.keyboard.type('fric');
await picture('2-add');
await page.keyboard.press('Escape');
await verb('Discover');
await page.waitForTimeout(1500);
await picture('3-discover-runs');
await page.waitForSelector('.card', {timeout: 400000});
await picture('3-discover-cards');
await page.click('.card button:text-is("Try")');
await page.waitForSelector('.block.new');
await picture('3-discover-try');
await page.click('.card button:text-is("Accept")');
await page.waitForTimeout(1000);
await tab('Waterfall');
await picture('3-waterfall');
await tab('Diff');
await picture('3-diff');
await page.click('.menu > button');
await picture('1-jobs');
await page.click('.shade');

await page.setInputFiles('input[type=file]', join(studio.folder, 'measured.csv')).catch(() => undefined);
await tab('Data');
await page.waitForTimeout(500);
await picture('4-data');

await studio.close();
