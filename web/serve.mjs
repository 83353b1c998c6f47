// @ts-check
// Serves web/dist on this machine, with the right types and compression. usage: node serve.mjs [--port 8080] [--root DIR]

import { readFile, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { dirname, extname, join, normalize, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { gzipSync } from 'node:zlib';

const TYPES = /** @type {Record<string, string>} */ ({
  '.html': 'text/html; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json',
  '.webmanifest': 'application/manifest+json',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.webp': 'image/webp',
  '.woff2': 'font/woff2',
  '.txt': 'text/plain; charset=utf-8',
  '.safetensors': 'application/octet-stream',
});
const PACKED = new Set(['.html', '.css', '.js', '.json', '.webmanifest', '.wasm', '.svg', '.txt']);

/** The policy of the page's own document, and what only a header can say. @param {string} document */
const policy = (document) => `${/http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(document)?.[1] ?? "default-src 'none'"}; frame-ancestors 'none'`;

/**
 * A server of the files under `root`, on this machine only.
 * @param {string} root
 */
export function server(root) {
  /** @type {Map<string, { time: number, body: Buffer<ArrayBuffer> }>} */
  const packed = new Map();
  return createServer(async (request, response) => {
    try {
      if (request.method !== 'GET' && request.method !== 'HEAD') {
        response.writeHead(405).end();
        return;
      }
      const path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
      const file = normalize(join(root, path.endsWith('/') ? `${path}index.html` : path));
      if (!file.startsWith(root + sep)) {
        response.writeHead(403).end();
        return;
      }
      const facts = await stat(file);
      if (!facts.isFile()) throw new Error('not a file');
      const tag = `"${facts.size.toString(36)}-${facts.mtimeMs.toString(36)}"`;
      const type = extname(file);
      const headers = { 'Content-Type': TYPES[type] ?? 'application/octet-stream', 'Cache-Control': 'no-cache', ETag: tag, 'X-Content-Type-Options': 'nosniff', Vary: 'Accept-Encoding' };
      if (request.headers['if-none-match'] === tag) {
        response.writeHead(304, headers).end();
        return;
      }
      let body = /** @type {Buffer<ArrayBuffer>} */ (await readFile(file));
      const more = type === '.html' ? { 'Content-Security-Policy': policy(body.toString()), 'Referrer-Policy': 'no-referrer' } : {};
      // What the build packed already.
      const best = PACKED.has(type) && /\bbr\b/.test(String(request.headers['accept-encoding'])) ? await readFile(`${file}.br`).catch(() => null) : null;
      if (best) {
        body = best;
        Object.assign(headers, { 'Content-Encoding': 'br' });
      } else if (PACKED.has(type) && /\bgzip\b/.test(String(request.headers['accept-encoding']))) {
        const known = packed.get(file);
        const fresh = known?.time === facts.mtimeMs ? known.body : gzipSync(body);
        packed.set(file, { time: facts.mtimeMs, body: fresh });
        body = fresh;
        Object.assign(headers, { 'Content-Encoding': 'gzip' });
      }
      response.writeHead(200, { ...headers, ...more, 'Content-Length': body.length });
      response.end(request.method === 'HEAD' ? undefined : body);
    } catch {
      response.writeHead(404, { 'Content-Type': 'text/plain' }).end('not found');
    }
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { values } = parseArgs({
    options: { port: { type: 'string', default: '8080' }, root: { type: 'string', default: join(dirname(fileURLToPath(import.meta.url)), 'dist') } },
  });
  const made = server(normalize(values.root));
  made.on('error', (error) => {
    console.error(/** @type {NodeJS.ErrnoException} */ (error).code === 'EADDRINUSE' ? `Port ${values.port} is in use; choose another with PORT=… or --port.` : String(error));
    process.exit(1);
  });
  made.listen(Number(values.port), '127.0.0.1', () => {
    const { port } = /** @type {import('node:net').AddressInfo} */ (made.address());
    console.log(`ltl-rover is at http://localhost:${port}/  (stop with Ctrl-C)`);
  });
}
