// What the server refuses, asked by other programs of the machine; jobs over a restart.

import {mkdirSync, symlinkSync, writeFileSync} from 'node:fs';
import {connect} from 'node:net';
import {request, type RequestOptions} from 'node:http';
import {join} from 'node:path';
import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import {Studio} from './studio';

describe('the server', () => {
  const studio = new Studio();
  beforeAll(async () => {
    studio.copy('docs/loop.json', 'loop.json');
    mkdirSync(join(studio.folder, 'inside'));
    symlinkSync('/etc', join(studio.folder, 'inside/out'));
    await studio.serve();
  });
  afterAll(() => studio.close());

  const ask = (path: string, headers: Record<string, string> = {}, method = 'GET', body = '') =>
    new Promise<{status: number; headers: Record<string, unknown>; text: string}>((resolve, reject) => {
      const options: RequestOptions = {port: studio.port, host: '127.0.0.1', path, method, headers: {Authorization: `Bearer ${studio.token}`, ...headers}};
      const sent = request(options, (reply) => {
        let text = '';
        reply.on('data', (part) => (text += part));
        reply.on('end', () => resolve({status: reply.statusCode!, headers: reply.headers, text}));
      });
      sent.on('error', reject);
      sent.end(body);
    });

  it('answers its own page alone', async () => {
    expect((await ask('/api/hello')).status).toBe(200);
    expect((await ask('/api/hello', {Host: 'evil.example'})).status).toBe(403);
    expect((await ask('/', {Host: `evil.example:${studio.port}`})).status).toBe(403);
    expect((await ask('/api/hello', {Origin: 'http://evil.example'})).status).toBe(403);
    expect((await ask('/api/hello', {Authorization: 'Bearer wrong'})).status).toBe(401);
    expect((await ask('/api/jobs', {Authorization: ''}, 'POST', '{"verb": "run", "diagram": "loop.json"}')).status).toBe(401);
    const page = await ask('/');
    expect(page.headers['content-security-policy']).toMatch(/default-src 'self'.*frame-ancestors 'none'/);
    expect(page.headers['access-control-allow-origin']).toBeUndefined();
  });

  it('hands out and changes nothing outside of its folder', async () => {
    for (const path of ['../../etc/passwd', '/etc/passwd', 'inside/out/passwd', 'inside/../../x'])
      expect(JSON.parse((await ask(`/api/file?path=${encodeURIComponent(path)}`)).text).problems[0].code).toBe('outside_folder');
    const written = await ask('/api/file', {}, 'PUT', JSON.stringify({path: '../evil.json', text: '{}', hash: ''}));
    expect(JSON.parse(written.text).problems[0].code).toBe('outside_folder');
    expect((await ask('/../../etc/passwd')).status).toBe(404);
    expect((await ask('/open/0123456789abcdef0123456789abcdef/etc/passwd')).status).toBe(404);
  });

  it('bears headers and bodies without end', async () => {
    const cut = await new Promise<boolean>((resolve) => {
      const socket = connect(studio.port, '127.0.0.1');
      let sent = 0;
      socket.on('error', () => resolve(true));
      socket.on('close', () => resolve(true));
      socket.write('GET / HTTP/1.1\r\nX: ');
      const more = () => {
        while (sent < 100e6 && socket.writable) {
          sent += 65536;
          if (!socket.write('x'.repeat(65536))) return void socket.once('drain', more);
        }
        if (sent >= 100e6) resolve(false);
      };
      more();
    });
    expect(cut).toBe(true);
    expect((await ask('/api/hello')).status).toBe(200);
  });

  it('refuses what is no request', async () => {
    for (const body of ['', '[]', '{', '{"path": 3}']) expect((await ask('/api/view', {}, 'POST', body)).status).toBeGreaterThanOrEqual(400);
    expect((await ask('/api/nothing')).status).toBe(404);
    expect((await ask('/api/edit', {}, 'POST', '{"path": "loop.json", "edits": [], "hash": "other"}')).status).toBe(409);
  });

  it('ends by Ctrl-C with 0, and finds its jobs again, also one that was killed', async () => {
    writeFileSync(join(studio.folder, 'long.json'), studio.read('loop.json').replace('"until": "1 s", "every": "1 ms"', '"until": "100000 s", "every": "10 s"'));
    const begin = async (diagram: string) => JSON.parse((await ask('/api/jobs', {}, 'POST', JSON.stringify({verb: 'run', diagram}))).text).id as string;
    const job = async (id: string) => JSON.parse((await ask('/api/state')).text).jobs.find((j: {id: string}) => j.id === id);
    const wait = async (id: string, states: string[]) => {
      for (let i = 0; i < 800 && !states.includes((await job(id)).state); ++i) await new Promise((r) => setTimeout(r, 25));
      return (await job(id)).state;
    };
    const quick = await begin('loop.json');
    expect(await wait(quick, ['done'])).toBe('done');
    const long = await begin('long.json');
    expect(await wait(long, ['running'])).toBe('running');
    expect(await studio.endServer()).toBe(0);
    await studio.serve();
    expect(await wait(quick, ['done'])).toBe('done');
    expect(await wait(long, ['running'])).toBe('running');
    process.kill(JSON.parse(studio.read(`.hysteron/jobs/${long}/job.json`)).pid, 'SIGKILL');
    expect(await wait(long, ['lost', 'failed'])).toBe('lost');
    const other = await begin('long.json');
    await wait(other, ['running']);
    await ask('/api/cancel', {}, 'POST', JSON.stringify({id: other}));
    expect(await wait(other, ['cancelled'])).toBe('cancelled');
  });
});
