/** What a page writes to its elements, frame by frame. */
import type { Page } from 'playwright-core';

/** The writes of a period. */
export interface PageWrites {
  /** Of each frame of the browser: `attributes style lil-slider`, `childList  number`. */
  readonly frames: readonly (readonly string[])[];
  /** Those that wrote what was there already. */
  readonly equal: readonly string[];
}

declare global {
  interface Window {
    /** Set by `writesOf`. */
    writes?: { readonly frames: number; end(): PageWrites };
  }
}

/** Does something, and returns what is written meanwhile. */
export async function writesOf(page: Page, act: () => Promise<unknown>): Promise<PageWrites> {
  await page.evaluate(() => {
    const records: { readonly record: MutationRecord; readonly frame: number }[] = [];
    let frames = 0;
    let isOver = false;
    const note = (list: MutationRecord[]) => records.push(...list.map((record) => ({ record, frame: frames })));
    const observer = new MutationObserver(note);
    const all = { subtree: true, attributes: true, childList: true, characterData: true };
    observer.observe(document, { ...all, attributeOldValue: true, characterDataOldValue: true });
    const count = () => {
      frames++;
      if (!isOver) requestAnimationFrame(count);
    };
    requestAnimationFrame(count);
    const words = ({ type, attributeName, target }: MutationRecord) => {
      const element = target instanceof Element ? target : target.parentElement;
      return `${type} ${attributeName ?? ''} ${element?.getAttribute('class') ?? element?.localName}`;
    };
    const textOf = (nodes: NodeList) => [...nodes].map((node) => node.textContent).join();
    /** What a record has left: what the next one of the same found, or what is there in the end. */
    const leftBy = ({ target, attributeName }: MutationRecord, from: number) => {
      const next = records
        .slice(from)
        .find(({ record: r }) => r.target === target && r.attributeName === attributeName);
      if (next) return next.record.oldValue;
      return target instanceof Element && attributeName ? target.getAttribute(attributeName) : target.nodeValue;
    };
    const isEqual = ({ record }: (typeof records)[number], i: number) =>
      record.type === 'childList'
        ? record.removedNodes.length > 0 && textOf(record.removedNodes) === textOf(record.addedNodes)
        : record.oldValue === leftBy(record, i + 1);
    window.writes = {
      get frames() {
        return frames;
      },
      end() {
        isOver = true;
        note(observer.takeRecords());
        observer.disconnect();
        const each = Array.from({ length: frames }, (_, f) => records.filter(({ frame }) => frame === f + 1));
        return {
          frames: each.map((own) => own.map(({ record }) => words(record))),
          equal: records.filter(isEqual).map(({ record }) => words(record)),
        };
      },
    };
  });
  await act();
  return page.evaluate(() => window.writes?.end() ?? { frames: [], equal: [] });
}

/** Waits for so many frames of a page whose writes are watched. */
export async function framesPass(page: Page, count: number): Promise<void> {
  await page.waitForFunction(
    (until) => (window.writes?.frames ?? 0) >= until,
    count + (await page.evaluate(() => window.writes?.frames ?? 0)),
  );
}
