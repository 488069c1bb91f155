// People's ways through data: a recording is dropped, asked about, and becomes a diagram or part of a data set.

import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {Studio} from './studio';

const rows = Array.from({length: 40}, (_, i) => [i / 10, Math.sin(i / 5), 3 * Math.sin(i / 5) + 1]);
const plain = `t [s],u [V],y [um]\n${rows.map((r) => r.map((v) => v.toFixed(4)).join(',')).join('\n')}\n`;
const german = `Zeit;Spannung;Weg\ns;V;\n${rows.map((r) => r.map((v) => v.toFixed(4).replace('.', ',')).join(';')).join('\n')}\n`;
const twoTimes = `time_a [s],time_b [s],u [V],y [um]\n${rows.map((r) => [r[0], 2 * r[0], r[1], r[2]].map((v) => v.toFixed(4)).join(',')).join('\n')}\n`;

describe('data', () => {
  const studio = new Studio();
  beforeAll(async () => {
    studio.copy('docs/loop.json', 'loop.json');
    await studio.serve();
    await studio.open();
  });
  afterAll(() => studio.close());

  /// As a file manager drops a file on the page.
  const drop = async (name: string, text: string) => {
    const data = await studio.page.evaluateHandle(([n, t]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([t], n));
      return transfer;
    }, [name, text]);
    await studio.page.dispatchEvent('.canvas', 'dragover', {dataTransfer: data});
    await studio.page.waitForSelector('.drop-here');
    await studio.page.dispatchEvent('.canvas', 'drop', {dataTransfer: data});
  };

  it('looks at a recording before anything is written', async () => {
    const {page} = studio;
    await drop('lab.csv', plain);
    await page.waitForSelector('.columns td:text-is("u")');
    expect(await page.locator('[aria-label="role of u"]').inputValue()).toBe('input');
    expect(await page.locator('[aria-label="role of y"]').inputValue()).toBe('output');
    expect(await page.locator('.panel-head .headline').textContent()).toBe('40 rows, 0 … 3.9 s');
    expect(studio.has('lab')).toBe(false);
    expect(studio.has('lab.csv')).toBe(false);
  });

  it('makes a diagram of it as the verb new does, and opens it', async () => {
    const {page} = studio;
    await page.click('button:text-is("New diagram")');
    await page.waitForSelector('.crumbs b:text-is("lab/diagram.json")');
    studio.write('elsewhere/lab.csv', plain);
    expect(studio.hysteron('new', '--from', 'elsewhere/lab.csv', '-o', 'terminal').code).toBe(0);
    for (const file of ['diagram.json', 'dataset.json', 'lab.csv']) expect(studio.read(`lab/${file}`).replace(/"\$schema": "[^"]*"/, '')).toBe(studio.read(`terminal/${file}`).replace(/"\$schema": "[^"]*"/, ''));
    expect(await page.locator('.topbar [aria-label="data"]').inputValue()).toBe('lab/dataset.json');
    await studio.verb('Compare');
    await page.waitForSelector('.bar-row');
  });

  it('asks what the file leaves open, and takes the answer', async () => {
    const {page} = studio;
    await drop('two.csv', twoTimes);
    await page.waitForSelector('.question:has-text("time_a, time_b")');
    expect(await page.isDisabled('button:text-is("New diagram")')).toBe(true);
    await page.selectOption('[aria-label="time column"]', 'time_b');
    await page.waitForSelector('.columns td:text-is("u")');
    expect(await page.locator('.question').count()).toBe(0);
    expect(await page.locator('.panel-head .headline').textContent()).toContain('7.8 s');
    await page.selectOption('[aria-label="role of time_a"]', 'without');
    await studio.until(async () => (await page.locator('[aria-label="role of time_a"]').inputValue()) === 'without');
    await page.click('[aria-label="discard the recording"]');
  });

  it('reads a decimal comma, and adds a recording to the data set by one line', async () => {
    const {page} = studio;
    const before = studio.read('lab/dataset.json');
    await drop('lab2.csv', plain.replace('0.0000,0.0000,1.0000', '0.0000,0.1000,1.0000'));
    await page.waitForSelector('.columns td:text-is("y")');
    await page.selectOption('[aria-label="role in the data set"]', 'validate');
    await page.click('button:text-is("Add to dataset.json")');
    await studio.until(() => studio.read('lab/dataset.json') !== before);
    const added = studio.read('lab/dataset.json').split('\n').filter((line) => !before.includes(line));
    expect(added.filter((line) => line.includes('lab2.csv'))).toEqual(['    {"file": "lab2.csv", "role": "validate"}']);
    expect(studio.has('lab/lab2.csv')).toBe(true);
    await page.waitForSelector('[aria-label="role of lab2.csv"]');
    await page.selectOption('[aria-label="role of lab2.csv"]', 'test');
    await studio.until(() => studio.read('lab/dataset.json').includes('{"file": "lab2.csv", "role": "test"}'));
    await drop('messung.csv', german);
    await page.waitForSelector('.assumed li:has-text("comma")');
    await page.click('[aria-label="discard the recording"]');
  });

  it('says what is no recording', async () => {
    const {page} = studio;
    await drop('picture.csv', '\u0000\u0001PNG');
    await page.waitForSelector('.question');
    await page.click('[aria-label="discard the recording"]');
    await drop('other.json', '{}');
    await page.waitForSelector('.banner.error:has-text("is no recording")');
  });

  it('leaves no complaint', () => expect(studio.complaints).toEqual([]));
});
