/** What a page holds, for tests that open and close things many times. */
import type { CDPSession, Page } from 'playwright-core';
import { type HeapBytes, heapBytesIn } from './heap-snapshot.ts';

export interface PageResources extends HeapBytes {
  readonly nodes: number;
  readonly listeners: number;
  /** On the GPU, as three.js counts them. */
  readonly geometries: number;
  readonly textures: number;
  /** Created less deleted, by `countResources`. */
  readonly gpuObjects: number;
  readonly objectUrls: number;
  readonly observers: number;
}

declare global {
  interface Window {
    /** Set by `countResources`. */
    counted?: { gpuObjects: number; objectUrls: number; observers: number };
  }
}

/** Runs in the page before its scripts: counts what the browser doesn't tell. */
export function countResources(): void {
  const counted = { gpuObjects: 0, objectUrls: 0, observers: 0 };
  window.counted = counted;
  const { prototype } = WebGL2RenderingContext;
  for (const kind of ['Buffer', 'Texture', 'Framebuffer', 'Renderbuffer', 'Program', 'Shader', 'VertexArray']) {
    // WebGL's methods by name; they are called with whatever three.js passes.
    const methods = prototype as unknown as Record<string, (...values: unknown[]) => unknown>;
    const { [`create${kind}`]: create, [`delete${kind}`]: remove } = methods;
    methods[`create${kind}`] = function (...values) {
      counted.gpuObjects++;
      return create.apply(this, values);
    };
    methods[`delete${kind}`] = function (...values) {
      if (values[0]) counted.gpuObjects--;
      return remove.apply(this, values);
    };
  }
  // All of them are lost with the context.
  const reset = () => {
    counted.gpuObjects = 0;
  };
  window.addEventListener('webglcontextlost', reset, { capture: true });
  const { createObjectURL, revokeObjectURL } = URL;
  URL.createObjectURL = (object) => {
    counted.objectUrls++;
    return createObjectURL.call(URL, object);
  };
  URL.revokeObjectURL = (url) => {
    counted.objectUrls--;
    revokeObjectURL.call(URL, url);
  };
  for (const Observer of [ResizeObserver, IntersectionObserver, MutationObserver]) {
    const seen = new WeakMap<object, number>();
    // One type for three classes that begin and end alike.
    const proto = Observer.prototype as { observe(...values: unknown[]): void; disconnect(): void };
    const { observe, disconnect } = proto;
    proto.observe = function (...values) {
      if (!seen.get(this)) counted.observers++;
      seen.set(this, 1);
      observe.apply(this, values);
    };
    proto.disconnect = function () {
      if (seen.get(this)) counted.observers--;
      seen.set(this, 0);
      disconnect.call(this);
    };
  }
}

/** What the page holds now, after a collection of garbage. @param readsHeap false: its bytes are left at 0 */
export async function resourcesOf(page: Page, readsHeap = true): Promise<PageResources> {
  const session = await page.context().newCDPSession(page);
  try {
    await session.send('Performance.enable');
    // What is only held by something that is finalised goes with the second.
    for (let i = 0; i < 2; i++) await session.send('HeapProfiler.collectGarbage');
    const heap = readsHeap ? heapBytesIn(await heapSnapshot(session)) : { heapBytes: 0, codeBytes: 0 };
    const { metrics } = await session.send('Performance.getMetrics');
    const metric = (name: string) => metrics.find((m) => m.name === name)?.value ?? Number.NaN;
    const own = await page.evaluate(() => {
      const { geometries, textures } = window.marrow.stats();
      return { geometries, textures, ...(window.counted ?? { gpuObjects: 0, objectUrls: 0, observers: 0 }) };
    });
    return { ...heap, nodes: metric('Nodes'), listeners: metric('JSEventListeners'), ...own };
  } finally {
    await session.detach();
  }
}

async function heapSnapshot(session: CDPSession): Promise<string> {
  const pieces: string[] = [];
  session.on('HeapProfiler.addHeapSnapshotChunk', ({ chunk }) => void pieces.push(chunk));
  await session.send('HeapProfiler.takeHeapSnapshot', { reportProgress: false });
  return pieces.join('');
}

/** `heap 31.2 → 31.4 MB, nodes 900 → 900 …`, of what differs. */
export function changeText(before: PageResources, after: PageResources): string {
  const changed = namesOf(before).filter((name) => textOf(name, before[name]) !== textOf(name, after[name]));
  const text = (name: keyof PageResources) => `${name} ${textOf(name, before[name])} → ${textOf(name, after[name])}`;
  return changed.map(text).join(', ') || 'all level';
}

/**
 * What has grown more than it may, in words.
 * @param most for each time; what has no limit may grow
 * @param times how often something was done in between
 */
export function grownPast(
  most: Partial<PageResources>,
  before: PageResources,
  after: PageResources,
  times = 1,
): readonly string[] {
  return namesOf(before).flatMap((name) => {
    const limit = most[name] ?? Infinity;
    const [was, is] = [before[name], after[name]];
    if (is - was <= times * limit) return [];
    const each = times === 1 ? '' : `, ${times} times`;
    return [`${name} grew from ${was} to ${is}: it may by ${limit}${each}`];
  });
}

const namesOf = (resources: PageResources) =>
  // It has no others.
  Object.keys(resources) as (keyof PageResources)[];

function textOf(name: keyof PageResources, value: number): string {
  return name === 'heapBytes' || name === 'codeBytes' ? `${(value / 1e6).toFixed(2)} MB` : String(value);
}
