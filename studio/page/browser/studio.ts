// Decides how tests open the studio: the built program on a folder of its own, and Chromium with trusted events.

import {spawn, spawnSync, type ChildProcess} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {chromium, type Browser, type Locator, type Page} from 'playwright-core';

export const program = process.env.HYSTERON_PROGRAM!;
const source = process.env.HYSTERON_SOURCE!;
const patience = Number(process.env.HYSTERON_PATIENCE ?? 100);  // [s]: a busy machine is no failure

/// A diagram of few blocks, as a person writes it. `blocks`: the lines of its blocks, `record`: what it records.
export const diagramOf = (blocks: string[], record: string[]) => `{
  "format": 1,
  "title": "Small",
  "blocks": {
${blocks.map((line) => `    ${line}`).join(',\n')}
  },
  "record": ${JSON.stringify(record).replaceAll(',', ', ')},
  "simulate": {"until": "1 s", "every": "1 ms"}
}
`;

export const drive = '"drive": {"type": "sine", "amplitude": "2 V", "frequency": "5 Hz"}';
/// Sources of two units and a block that one of them fits; nothing is wired.
export const unwired = diagramOf([drive, '"force": {"type": "constant", "value": "1 N"}', '"limit": {"type": "saturation", "lower": "0 V", "upper": "10 V"}'],
                                 ['drive', 'force', 'limit']);

/// Waits by locators where much is done: a handle that waitForSelector gives keeps what the page has removed.
export class Studio {
  readonly folder = mkdtempSync(join(tmpdir(), 'hysteron-studio-'));
  readonly complaints: string[] = [];
  private server!: ChildProcess;
  private browser!: Browser;
  page!: Page;

  write(name: string, text: string): void {
    mkdirSync(dirname(join(this.folder, name)), {recursive: true});
    writeFileSync(join(this.folder, name), text);
  }
  has = (name: string) => existsSync(join(this.folder, name));
  read = (name: string) => readFileSync(join(this.folder, name), 'utf8');
  copy = (from: string, to: string) => cpSync(join(source, from), join(this.folder, to), {recursive: true});
  get address(): string {
    return JSON.parse(this.read('.hysteron/studio.json')).address;
  }
  get port(): number {
    return Number(new URL(this.address).port);
  }
  get token(): string {
    return this.address.split('#token=')[1];
  }

  get pid(): number {
    return this.server.pid!;
  }

  async serve(port = 0): Promise<void> {
    this.server = spawn(program, ['studio', this.folder, '--no-browser', ...(port ? ['--port', String(port)] : [])], {stdio: 'ignore'});
    while (!existsSync(join(this.folder, '.hysteron/studio.json'))) await new Promise((r) => setTimeout(r, 20));
  }
  async endServer(): Promise<number | null> {
    const ended = new Promise<number | null>((r) => this.server.once('exit', r));
    this.server.kill('SIGINT');
    return ended;
  }

  async open(): Promise<Page> {
    if (!this.browser) this.browser = await chromium.launch({executablePath: process.env.HYSTERON_CHROMIUM, args: ['--no-sandbox', '--disable-gpu']});
    const context = await this.browser.newContext({viewport: {width: 1280, height: 800}, permissions: ['clipboard-read', 'clipboard-write']});
    this.page = await context.newPage();
    this.page.setDefaultTimeout(1000 * patience);
    this.page.on('console', (m) => m.type() === 'error' && this.complaints.push(`${m.text()} ${m.location().url}`));
    this.page.on('pageerror', (e) => this.complaints.push(e.message));
    this.page.on('request', (r) => {
      if (!r.url().startsWith(`http://127.0.0.1:${this.port}/`) && !/^(data|blob):/.test(r.url())) this.complaints.push(`a request to ${r.url()}`);
    });
    if (process.env.HYSTERON_PAGE) await this.servePage(process.env.HYSTERON_PAGE);
    await this.page.goto(this.address);
    await this.page.locator('.frame').first().waitFor();
    return this.page;
  }
  /// The page as vite has just built it, in front of the one that is in the program: for work on the page.
  private async servePage(folder: string): Promise<void> {
    const types: Record<string, string> = {html: 'text/html', js: 'text/javascript', css: 'text/css', svg: 'image/svg+xml'};
    await this.page.route(/^http:\/\/127\.0\.0\.1:\d+\/[a-z.]*$/, (route) => {
      const name = new URL(route.request().url()).pathname.slice(1) || 'index.html';
      return route.fulfill({body: readFileSync(join(folder, name)), contentType: types[name.split('.').pop()!]});
    });
  }
  /// The studio on a folder with these files; the first of them is open.
  async openOn(files: Record<string, string>): Promise<void> {
    for (const [name, text] of Object.entries(files)) this.write(name, text);
    await this.serve();
    await this.open();
    await this.openDiagram(Object.keys(files)[0]);
  }
  async close(): Promise<void> {
    await this.browser?.close();
    if (this.server?.exitCode === null) await this.endServer();
    rmSync(this.folder, {recursive: true, force: true});
  }

  async openDiagram(name: string): Promise<void> {
    await this.page.click('.sidebar button:text-is("Files")');
    await this.page.click(`.entry.file[data-path="${name}"]`);
    await this.page.locator(`.crumbs b:text-is("${name}")`).first().waitFor();
    await this.page.locator('.react-flow__node').first().waitFor();
    await this.page.waitForTimeout(300);  // the view is fitted in the next frame
  }
  /// A verb of the bar, and a tab of the results.
  verb = (label: string) => this.page.click(`.topbar button:text-is("${label}")`);
  tab = (label: string) => this.page.click(`.results .tabs button:text-is("${label}")`);
  block = (name: string) => this.page.locator(`.react-flow__node[data-id="${name}"]`);

  /// Where something is once it stays there: the edit before may still be on its way to the canvas.
  private async resting(what: Locator): Promise<{x: number; y: number; width: number; height: number}> {
    for (let before = '';;) {
      const box = (await what.boundingBox())!;
      if (JSON.stringify(box) === before) return box;
      before = JSON.stringify(box);
      await this.page.waitForTimeout(150);
    }
  }

  /// Drags from an output to an input, as a hand does.
  async wire(from: string, to: string, input = 0): Promise<void> {
    const a = await this.resting(this.block(from).locator('.port-out').first());
    const b = await this.resting(this.block(to).locator('.port-in').nth(input));
    await this.page.mouse.move(a.x + a.width / 2, a.y + a.height / 2);
    await this.page.mouse.down();
    await this.page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2, {steps: 4});
    await this.page.locator('.react-flow__handle.fits, .react-flow__handle.misfit').first().waitFor({state: 'attached'});
    await this.page.mouse.move(b.x + b.width / 2, b.y + b.height / 2, {steps: 4});
    await this.page.mouse.up();
  }
  async until(what: () => boolean | Promise<boolean>): Promise<void> {
    for (let i = 0; i < 40 * patience; ++i) {
      if (await what()) return;
      await this.page.waitForTimeout(25);
    }
    throw new Error(`it did not come true in ${patience} s`);
  }
  hysteron(...words: string[]): {code: number | null; out: string; err: string} {
    const done = spawnSync(program, words, {cwd: this.folder, encoding: 'utf8'});
    return {code: done.status, out: done.stdout, err: done.stderr};
  }
}
