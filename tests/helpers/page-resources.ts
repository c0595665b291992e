/** What a page holds, for tests that open and close things many times. */
import type { Page } from 'playwright-core';

export interface PageResources {
  /** Of scripts, after a collection of garbage. */
  readonly heapBytes: number;
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

/** What the page holds now. */
export async function resourcesOf(page: Page): Promise<PageResources> {
  const session = await page.context().newCDPSession(page);
  try {
    await session.send('Performance.enable');
    // What is only held by something that is finalised goes with the second.
    for (let i = 0; i < 2; i++) await session.send('HeapProfiler.collectGarbage');
    const { metrics } = await session.send('Performance.getMetrics');
    const metric = (name: string) => metrics.find((m) => m.name === name)?.value ?? Number.NaN;
    const own = await page.evaluate(() => {
      const { geometries, textures } = window.marrow.stats();
      return { geometries, textures, ...(window.counted ?? { gpuObjects: 0, objectUrls: 0, observers: 0 }) };
    });
    return {
      heapBytes: metric('JSHeapUsedSize'),
      nodes: metric('Nodes'),
      listeners: metric('JSEventListeners'),
      ...own,
    };
  } finally {
    await session.detach();
  }
}

/** `heap 31.2 → 31.4 MB, nodes 900 → 900 …`, of what differs. */
export function changeText(before: PageResources, after: PageResources): string {
  const names = Object.keys(before) as (keyof PageResources)[];
  const value = (name: keyof PageResources, of: PageResources) =>
    name === 'heapBytes' ? `${(of[name] / 1e6).toFixed(1)} MB` : String(of[name]);
  const changed = names.filter((name) => value(name, before) !== value(name, after));
  return changed.map((name) => `${name} ${value(name, before)} → ${value(name, after)}`).join(', ') || 'all level';
}
