/**
 * A workbench whose viewport knows poses and positions but draws nothing: the camera looks along −z, 100 pixels per
 * world unit, with the world's origin at 0, 0 of the page.
 */
import { vi } from 'vitest';
import { shownAt } from '../../../../src/edit/rig/shown.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { type Character, type Document, findCharacter } from '../../../../src/model/document.ts';
import type { Pin } from '../../../../src/model/ik.ts';
import type { Joint, Skeleton } from '../../../../src/model/skeleton/skeleton.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { character, documentOf, joint, workbench } from '../../builders.ts';

export const PIXELS_PER_UNIT = 100;

const bone = (name: string, parent: number, offset: Vec3): Joint => ({ ...joint(name, parent), offset });

/** A body at the origin with an arm of three bones to either side, bent: hands at −3 and 3. */
export const BODY: Skeleton = {
  name: 'body',
  joints: [
    bone('body', -1, [0, 0, 0]),
    bone('arm_l', 0, [1, 0, 0]),
    bone('fore_l', 1, [1, 0.5, 0]),
    bone('hand_l', 2, [1, -0.5, 0]),
    bone('arm_r', 0, [-1, 0, 0]),
    bone('fore_r', 4, [-1, 0.5, 0]),
    bone('hand_r', 5, [-1, -0.5, 0]),
  ],
};
export const [BODY_JOINT, , FORE_L, HAND_L, , FORE_R, HAND_R] = BODY.joints.keys();

export const pin = (id: number, on: number, more: Partial<Pin> = {}): Pin => ({
  id,
  joint: on,
  point: [0, 0, 0],
  weight: 1,
  holdsOrientation: false,
  ...more,
});

/** With both hands pinned. */
export const body = (more: Partial<Character> = {}): Character =>
  character({
    skeleton: BODY,
    ik: { pins: [pin(1, HAND_L), pin(2, HAND_R)], stiff: [], rootIsFree: true },
    ...more,
  });

/** `stop` restores the window. */
export function ikPage(document: Document = documentOf(body())) {
  vi.stubGlobal('window', new EventTarget());
  const { wb } = workbench(document);
  const shown = (id: string) => {
    const found = findCharacter(wb.store.document, id);
    return found?.skeleton && shownAt(found, wb.transport.get().timeSeconds);
  };
  const viewport = {
    character: (id: string) => {
      const now = shown(id);
      return now && { dofs: now.dofs, worlds: now.world, worldMatrices: () => now.world, vertices: () => [] };
    },
    placementOf: (id: string) => {
      const isSeen = findCharacter(wb.store.document, id)?.isHidden !== true;
      return isSeen ? Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) : undefined;
    },
    pickedCopy: () => 0,
    requestRender: () => {},
    freezeRootMotion: () => () => {},
    eye: {
      toScreen: ([x, y, z]: Vec3) => ({ x: PIXELS_PER_UNIT * x, y: -PIXELS_PER_UNIT * y, depth: 10 - z }),
      inPlaneOf: (anchor: Vec3, x: number, y: number): Vec3 => [x / PIXELS_PER_UNIT, -y / PIXELS_PER_UNIT, anchor[2]],
      inDepth: ([x, y, z]: Vec3, distance: number): Vec3 => [x, y, z - distance],
      unitsPerPixel: () => 1 / PIXELS_PER_UNIT,
    },
  };
  // Nothing that these tests use needs a browser.
  const page: Workbench = { ...wb, viewport: { ...wb.viewport, ...viewport } as unknown as Workbench['viewport'] };
  const placeOf = (on: number, id = 'c1'): Vec3 => {
    const world = shown(id)?.world ?? new Float64Array(0);
    return [world[16 * on + 12], world[16 * on + 13], world[16 * on + 14]];
  };
  const pose = () => page.store.document.characters[0].pose;
  return { wb: page, placeOf, pose, stop: () => void vi.unstubAllGlobals() };
}

export function apart(a: Vec3, b: Vec3): number {
  return Math.hypot(...a.map((v, k) => v - b[k]));
}
