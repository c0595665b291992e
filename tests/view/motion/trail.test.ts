import { GreaterDepth } from 'three';
import { describe, expect, it, vi } from 'vitest';
import { steppedCharacter } from '../../../src/evaluate/stepped-take.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { DEFAULT_DISPLAY } from '../../../src/model/session.ts';
import { Ghosts } from '../../../src/view/motion/ghosts.ts';
import { MotionDrawing } from '../../../src/view/motion/motion-drawing.ts';
import { samplePath, Trail } from '../../../src/view/motion/trail.ts';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';

const path = (...of: Parameters<typeof samplePath>) => runToEnd(samplePath(...of));

describe('the trail of a joint', () => {
  const still = character({ skeleton: skeleton(2), takes: [], shownTake: -1 });
  const pose = still.pose.map((value, dof) => (dof === 0 ? 3 : value));

  it('the motion path is where the joint is at each time', () => {
    const sampled = path({ ...still, pose }, 0, [0, 1], 4, false);
    expect(sampled).toHaveLength(12);
    for (let i = 0; i < 4; i++) expect(sampled[3 * i]).toBeCloseTo(3, 12);
  });

  it('leaves out the root motion in place', () => {
    const sampled = path({ ...still, pose }, 0, [0, 1], 2, true);
    expect(sampled[0]).toBeCloseTo(0, 12);
  });

  it('covers the range, both ends included', () => {
    const moving = { ...still, takes: [takeOfValues('walk', [0, 8])], shownTake: 0 };
    const one = path(moving, 0, [0, 1], 5, false);
    const ends = path(moving, 0, [0, 1], 2, false);
    expect(Array.from(one.subarray(0, 3))).toEqual(Array.from(ends.subarray(0, 3)));
    expect(Array.from(one.subarray(12))).toEqual(Array.from(ends.subarray(3)));
  });

  it('a path over all of time to where no 32-bit float reaches is drawn without complaint', () => {
    const away = takeOfValues('away', [1e308, -1e308]);
    const moving = character({ skeleton: skeleton(2), takes: [away], shownTake: 0 });
    expect(path(moving, 0, [-1e308, 1e308], 5, false).every((value) => !Number.isNaN(value))).toBe(true);
    const trail = new Trail();
    trail.show(moving, 0, [0, 1], false);
    // three.js has no need to compute it, and to find that it isn't one.
    expect(trail.object.geometry.boundingSphere?.radius).toBe(-1);
  });

  it('with a stepped preview the path and the ghosts are of the poses that are held', () => {
    const moving = character({ skeleton: skeleton(2), takes: [takeOfValues('walk', [0, 8])], shownTake: 0 });
    const entry = { id: moving.id, character: moving };
    const made = new MotionDrawing({ seen: () => entry, visible: [entry] } as never, () => undefined, {} as never);
    const drawn = vi.spyOn(Trail.prototype, 'show');
    const ghosts = vi.spyOn(Ghosts.prototype, 'fill');
    const display = { ...DEFAULT_DISPLAY, trail: true, ghosts: true };
    for (const stepped of [true, false]) {
      made.show({ characterId: moving.id, joint: 0 }, { ...display, stepped }, [0, 1]);
      made.fill({ characterId: moving.id }, { ...display, stepped }, 0.5, [0, 1], 30);
      const of = stepped ? steppedCharacter(moving) : moving;
      expect(drawn.mock.lastCall?.[0]).toBe(of);
      expect(ghosts.mock.lastCall?.[0]).toBe(of);
    }
    const held = path(steppedCharacter(moving), 0, [0, 1], 3, false);
    expect(Array.from(held.subarray(3, 6))).toEqual(Array.from(held.subarray(0, 3)));
    made.dispose();
    vi.restoreAllMocks();
  });

  it('shows through what covers it, dimmed, at the same places', () => {
    const moving = character({ skeleton: skeleton(2), takes: [takeOfValues('walk', [0, 8])], shownTake: 0 });
    const trail = new Trail();
    trail.show(moving, 1, [0, 1], false);
    const { object, covered } = trail;
    expect(object.children).toContain(covered);
    expect(covered.geometry).toBe(object.geometry);
    expect(covered.instanceMatrix).toBe(object.instanceMatrix);
    expect(covered.count).toBe(object.count);
    const { depthFunc, depthWrite, uniforms } = covered.material;
    expect([depthFunc, depthWrite]).toEqual([GreaterDepth, false]);
    expect(uniforms.opacity.value).toBeLessThan(0.6 * object.material.uniforms.opacity.value);
    // After skins and bones, which may cover it.
    expect(covered.renderOrder).toBeGreaterThan(object.renderOrder);
    trail.show(undefined, undefined, [0, 1], false);
    expect(object.visible).toBe(false);
  });

  describe('of a character of thousands of joints', () => {
    const large = character({
      id: 'large',
      skeleton: skeleton(3000),
      takes: [takeOfValues('walk', [1])],
      shownTake: 0,
    });
    const range = [0, 2] as const;

    it('is sampled between frames, and drawn then', async () => {
      const redraw = vi.fn();
      const trail = new Trail(redraw);
      trail.show(large, 7, range, false);
      expect(trail.object.visible).toBe(false);
      await vi.waitFor(() => expect(redraw).toHaveBeenCalledOnce(), 20_000);
      expect(trail.object.visible).toBe(true);
      expect(trail.object.count).toBe(1);
      const later = { ...large, name: 'renamed' };
      trail.show(later, 7, range, false);
      // The former path stays until the new one is there.
      expect(trail.object.visible).toBe(true);
      trail.dispose();
    });

    it('is not drawn any more once another joint, or none, is selected', async () => {
      const redraw = vi.fn();
      const trail = new Trail(redraw);
      trail.show(large, 7, range, false);
      trail.show(large, undefined, range, false);
      trail.show(
        character({ skeleton: skeleton(2), takes: [takeOfValues('walk', [1])], shownTake: 0 }),
        1,
        range,
        false,
      );
      const { geometry } = trail.object;
      expect(trail.object.visible).toBe(true);
      trail.show(large, 8, range, false);
      expect(trail.object.visible).toBe(false);
      trail.show(large, undefined, range, false);
      const done = new Trail(redraw);
      done.show(large, 8, range, false);
      await vi.waitFor(() => expect(redraw).toHaveBeenCalledOnce(), 20_000);
      expect(trail.object.visible).toBe(false);
      expect(trail.object.geometry).toBe(geometry);
    });
  });
});
