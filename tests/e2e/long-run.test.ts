/** Two of the attacks for a few tries: what is opened is given back when it is closed, and a lost picture comes again. */
import { describe, expect, it } from 'vitest';
import { type Attack, chanceOf } from '../attack/attack.ts';
import { lostContext } from '../attack/page/lost-context.ts';
import { openAndClose } from '../attack/page/open-close.ts';
import { withPage } from '../helpers/page.ts';
import { countResources } from '../helpers/page-resources.ts';

/** What gave way in so many tries. */
async function foundBy({ run }: Attack, tries: number): Promise<readonly string[]> {
  const found: string[] = [];
  let [asked, tried] = [0, 0];
  await run({
    seed: 1,
    ...chanceOf(1),
    readsHeap: false,
    goesOn: () => asked++ < tries,
    tried: (count = 1) => {
      tried += count;
    },
    gaveWay: (what) => void found.push(what),
    note: () => undefined,
  });
  expect(tried).toBe(tries);
  return found;
}

describe('in the long run', () => {
  it('menus, dialogs, panels, tabs, modes and files of all kinds leave nothing behind when they are closed', () =>
    withPage(
      async ({ page }) => {
        const { dialogs, before, after } = await openAndClose(page, 1, () => false, false);
        expect(dialogs).toBeGreaterThan(10);
        expect(after.gpuObjects).toBeLessThanOrEqual(before.gpuObjects);
        expect(after.observers).toBeLessThanOrEqual(before.observers);
        expect(after.objectUrls).toBeLessThanOrEqual(before.objectUrls);
        // A message for each refused file and its undo may come; a dialog that stayed would be hundreds of nodes.
        expect(after.nodes).toBeLessThan(before.nodes + 250);
        expect(after.listeners).toBeLessThan(before.listeners + 60);
      },
      { size: { width: 1280, height: 800 }, before: countResources },
    ));

  it('the picture is the same after the graphics context was lost while idle, playing, dragging, loading and frozen', async () => {
    const found = await foundBy(lostContext, 5);
    expect(found).toEqual([]);
  });
});
