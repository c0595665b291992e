/** Drags of hands by real mouse: what moves, and that nothing else does. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { transformPoint } from '../../../src/math/vec3.ts';
import { apart, drawn, onPage, type Point, standing, undoLabel } from './ik.ts';

/** CSS pixels: how far a held point of the hand may be from the pointer; the hand may turn about the point pressed. */
const NEAR_POINTER = 8;

/** What is pressed: a point of a joint's space, and how far the mouse goes from there, in CSS pixels. */
export interface Hold {
  readonly joint: number;
  readonly point: Point;
  readonly by: readonly [x: number, y: number];
}

export interface Shown {
  readonly names: readonly string[];
  readonly worlds: readonly (readonly number[])[];
  readonly dofs: readonly number[];
}

export const shown = (page: Page): Promise<Shown> =>
  page.evaluate(() => {
    const [{ joints, dofs }] = window.marrow.characters();
    return { names: joints.map(({ name }) => name), worlds: window.marrow.worldMatrices(), dofs };
  });

/** The values of the first character's DOFs at some times. @param then the time shown afterwards */
export const dofsAt = (page: Page, times: readonly number[], then: number) =>
  page.evaluate(
    ([all, last]) => {
      const found = all.map((time) => {
        window.marrow.seek(time);
        return window.marrow.characters()[0].dofs;
      });
      window.marrow.seek(last);
      return found;
    },
    [times, then] as const,
  );

/** A point of a joint, by default its pivot. */
export function place({ worlds }: Shown, joint: number, point: Point = [0, 0, 0]): Point {
  return transformPoint(Float64Array.from(worlds[joint]), point);
}

/** Presses there and goes up; `there` while the mouse is down. */
export async function dragUp(
  page: Page,
  { joint, point, by: [dx, dy] }: Hold,
  there: () => Promise<void>,
): Promise<void> {
  const from = await onPage(page, place(await shown(page), joint, point));
  await page.mouse.move(from.x, from.y);
  await drawn(page);
  await page.mouse.down();
  await page.mouse.move(from.x + dx, from.y + dy, { steps: 4 });
  await drawn(page);
  const now = await onPage(page, place(await shown(page), joint, point));
  expect(Math.hypot(now.x - from.x - dx, now.y - from.y - dy)).toBeLessThan(NEAR_POINTER);
  await there();
  await page.mouse.up();
}

/** A hand goes up with the mouse, and of all others only its arm moves; undo restores every number. */
export async function expectArmOnly(page: Page, hold: Hold, arm: readonly number[]): Promise<void> {
  await page.evaluate(() => window.marrow.run('view.front'));
  await standing(page);
  const before = await shown(page);
  await dragUp(page, hold, async () => {
    const now = await shown(page);
    const moved = now.worlds.flatMap((world, j) => (apart(world, before.worlds[j]) > 1e-9 ? [j] : []));
    expect(moved.filter((j) => !arm.includes(j))).toEqual([]);
    expect(moved).toContain(hold.joint);
    expect(moved.length).toBeGreaterThan(1);
  });
  await expect.poll(() => undoLabel(page)).toMatch(/^Drag /);
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => shown(page)).toEqual(before);
}

/** The joint and all below it. */
export async function limbFrom(page: Page, name: string): Promise<readonly number[]> {
  return page.evaluate((wanted) => {
    const [{ joints }] = window.marrow.characters();
    const found = new Set<number>();
    for (const joint of joints) if (joint.name === wanted || found.has(joint.parent)) found.add(joint.index);
    return [...found];
  }, name);
}

/**
 * Moves the mouse from the middle of a gizmo outwards, until the chip names a handle.
 *
 * @param toward on the page; x to the right, y down
 * @param is of the chip's text, such as `ty 0.9`
 */
export async function ontoHandle(
  page: Page,
  middle: { readonly x: number; readonly y: number },
  toward: readonly [x: number, y: number],
  is: RegExp,
): Promise<{ readonly x: number; readonly y: number }> {
  const length = Math.hypot(...toward);
  const way = { x: toward[0] / length, y: toward[1] / length };
  // The first of them in the page, since moving the mouse waits for a frame each time; from there on by the mouse.
  const begin = await page.evaluate(
    async ({ middle, way, source }) => {
      const canvas = document.querySelector('.viewport canvas[role=application]');
      for (let radius = 20; radius < 220; radius += 3) {
        const at = { clientX: middle.x + radius * way.x, clientY: middle.y + radius * way.y };
        canvas?.dispatchEvent(new PointerEvent('pointermove', { ...at, bubbles: true, isPrimary: true }));
        await new Promise(requestAnimationFrame);
        const chips = [...document.querySelectorAll<HTMLElement>('.gizmo-chip .hand-readout')];
        if (chips.some((chip) => chip.checkVisibility() && new RegExp(source).test(chip.textContent ?? '')))
          return radius;
      }
      return 20;
    },
    { middle, way, source: is.source },
  );
  const chip = page.locator('.gizmo-chip .hand-readout:visible');
  for (let radius = begin; radius < 220; radius += 3) {
    const at = { x: middle.x + radius * way.x, y: middle.y + radius * way.y };
    await page.mouse.move(at.x, at.y);
    if ((await chip.allTextContents()).some((text) => is.test(text))) return at;
  }
  throw new Error(`No handle there is named ${is}.`);
}
