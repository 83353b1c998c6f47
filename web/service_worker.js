// @ts-check
/// <reference lib="webworker" />
// Keeps the page for use without a network. The build fills in the version and the list of files.

const scope = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
const CACHE = `ltl-rover-${'VERSION'}`;
/** @type {string[]} */
const FILES = [/* FILES */];

scope.addEventListener('install', (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(FILES)).then(() => scope.skipWaiting()));
});

scope.addEventListener('activate', (event) => {
  event.waitUntil(
    caches.keys()
      .then((names) => Promise.all(names.filter((name) => name.startsWith('ltl-rover-') && name !== CACHE).map((name) => caches.delete(name))))
      .then(() => scope.clients.claim()),
  );
});

// The network first, so that a page that was rebuilt is seen at once; what was kept when there is none.
scope.addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || new URL(request.url).origin !== scope.location.origin) return;
  event.respondWith(
    fetch(request).catch(async () => {
      const kept = await caches.match(request, { ignoreSearch: true });
      return kept ?? new Response('This file is not available without a network.', { status: 503 });
    }),
  );
});
