import { describe, expect, it } from 'vitest';
import { activeDof, chooseDof, dofsByHand } from '../../../../src/ui/editors/posing/active-dof.ts';
import { actionsOf, runAction } from '../../../../src/ui/state/actions/action.ts';
import { selectedJoint } from '../../../../src/ui/state/joints/selected-joint.ts';
import { actionFor } from '../../../../src/ui/state/shortcuts.ts';
import { channel, character, documentOf, joint, skeleton, take, workbench } from '../../builders.ts';

const armature = skeleton(['hips', -1], ['leg', 0], ['foot', 1]);

function posing(more: Parameters<typeof character>[0] = {}) {
  const made = workbench(documentOf(character({ skeleton: armature, ...more })));
  const turns: (readonly [what: string, ...by: number[]])[] = [];
  Object.assign(made.wb.viewport.camera, {
    turn: (azimuth: number, polar: number) => void turns.push(['view', Math.sign(azimuth), Math.sign(polar)]),
    turnCharacter: (id: string, angle: number) => void turns.push([id, angle]),
  });
  const press = (key: string, panel?: string) => {
    const { wb } = made;
    const action = actionFor([key], actionsOf(wb), panel, wb.settings.get());
    if (action && action.refuses?.(wb) === undefined) action.run(wb);
  };
  return { ...made, turns, press };
}

describe('the keys of posing', () => {
  it('switch between FK and IK, to rig mode, and back to Pose', () => {
    const { wb, press } = posing();
    const seen = ['E', 'E', 'Shift+E', 'E', 'W', 'E'].map((key) => {
      press(key);
      return wb.posing.mode.get();
    });
    expect(seen).toEqual(['ik', 'fk', 'rig', 'fk', 'pose', 'ik']);
  });

  it.each(['viewport', 'outliner', undefined])('Escape leaves rig mode, then deselects (%s)', (panel) => {
    const { wb, press } = posing();
    wb.store.select({ characterId: 'c1', joint: 1 });
    wb.posing.mode.set('rig');
    press('Escape', panel);
    expect([wb.posing.mode.get(), wb.store.selection.joint]).toEqual(['pose', 1]);
    press('Escape', panel);
    expect(wb.store.selection.characterId).toBeUndefined();
  });

  it.each(['viewport', 'outliner', undefined])('Escape deselects in IK mode, and never leaves it (%s)', (panel) => {
    const { wb, press } = posing();
    wb.store.select({ characterId: 'c1', joint: 1 });
    wb.posing.mode.set('ik');
    for (let i = 0; i < 3; i++) {
      press('Escape', panel);
      expect([wb.posing.mode.get(), wb.store.selection.characterId]).toEqual(['ik', undefined]);
    }
  });

  it('Q takes the select tool, and Q, Escape or E leave it', () => {
    const { wb, press } = posing();
    wb.store.select({ characterId: 'c1', joint: 1 });
    const after = (key: string) => {
      press(key, 'viewport');
      return wb.posing.mode.get();
    };
    expect(['Q', 'Q'].map(after)).toEqual(['select', 'pose']);
    wb.posing.mode.set('ik');
    expect(['Q', 'Q', 'Q', 'Escape'].map(after)).toEqual(['select', 'ik', 'select', 'ik']);
    expect(['Q', 'E'].map(after)).toEqual(['select', 'fk']);
    expect(wb.store.selection.joint).toBe(1);
  });

  it('the keys [ and ] change the size of the gizmo within bounds, and say where they end', () => {
    const { wb, press } = posing();
    const size = () => wb.settings.get().gizmoScale;
    press(']', 'viewport');
    expect(size()).toBeCloseTo(2 ** (1 / 3), 12);
    for (let i = 0; i < 6; i++) press(']');
    expect(size()).toBe(2);
    const larger = actionsOf(wb).find(({ id }) => id === 'gizmo.larger');
    expect(larger?.refuses?.(wb)).toContain('as large as it gets');
    for (let i = 0; i < 9; i++) press('[');
    expect(size()).toBe(0.5);
    wb.posing.mode.set('rig');
    press(']');
    expect(size()).toBe(0.5);
    expect(larger?.refuses?.(wb)).toBe('Only Pose, FK and IK modes have a gizmo.');
    wb.posing.mode.set('ik');
    press(']');
    expect(size()).toBeGreaterThan(0.5);
  });

  it('Escape has one line on the page of shortcuts', () => {
    const { wb } = posing();
    const lines = actionsOf(wb).filter(({ shortcuts, panel }) => shortcuts?.includes('Escape') && !panel);
    expect(lines.map((action) => action.label)).toEqual(['Leave rig mode or the select tool, or deselect all']);
  });

  it('Space switches modes if there is nothing to play, and plays otherwise', () => {
    const still = posing();
    still.press('Space');
    expect([still.wb.posing.mode.get(), still.wb.transport.get().playing]).toEqual(['ik', false]);
    // The transport's button plays all the same.
    void runAction(still.wb, 'play.toggle', 'button');
    expect(still.wb.transport.get().playing).toBe(true);
    still.press('Space');
    expect([still.wb.posing.mode.get(), still.wb.transport.get().playing]).toEqual(['ik', false]);
    const moving = posing({ takes: [take([0, 1], channel(0, 1))] });
    moving.press('Space');
    expect([moving.wb.posing.mode.get(), moving.wb.transport.get().playing]).toEqual(['pose', true]);
  });

  it.each(['viewport', undefined])('left and right step frames with a take, playing or not (%s)', (panel) => {
    const { wb, turns, press } = posing({ takes: [take([0, 1], channel(0, 1))] });
    const frame = () => wb.transport.get().timeSeconds * wb.transport.get().framesPerSecond;
    press('Right', panel);
    press('Right', panel);
    press('Left', panel);
    expect(frame()).toBeCloseTo(1, 9);
    wb.transport.update((now) => ({ ...now, playing: true }));
    press('Right', panel);
    expect([frame(), wb.transport.get().playing]).toEqual([2, false]);
    expect(turns).toEqual([]);
  });

  it('left and right turn the character where it is without a take, and the transport’s buttons step', () => {
    const { wb, turns, press } = posing();
    press('Right', 'viewport');
    press('Left', 'viewport');
    const [[who, by], back] = turns;
    expect([who, Math.sign(by)]).toEqual(['c1', 1]);
    expect(back).toEqual(['c1', -by]);
    const { document } = wb.store;
    void runAction(wb, 'play.stepForward', 'button');
    expect(wb.transport.get().timeSeconds).toBeGreaterThan(0);
    wb.transport.update((now) => ({ ...now, playing: true }));
    press('Right', 'viewport');
    expect(turns).toHaveLength(2);
    expect([wb.store.document, wb.store.undoLabel]).toEqual([document, undefined]);
  });

  it('left and right step frames of a take that is only reviewed', () => {
    const { wb, turns, press } = posing();
    wb.timeline.review.shown.set({} as NonNullable<ReturnType<typeof wb.timeline.review.shown.get>>);
    press('Right', 'viewport');
    expect([turns.length, wb.transport.get().timeSeconds > 0]).toEqual([0, true]);
  });

  it('the arrow keys orbit the view with Ctrl, wherever the focus is but in the timeline', () => {
    const { turns, press } = posing({ takes: [take([0, 1], channel(0, 1))] });
    for (const key of ['Left', 'Right', 'Up', 'Down']) press(`Ctrl+${key}`, 'viewport');
    press('Ctrl+Left');
    press('Ctrl+Left', 'timeline');
    expect(turns).toEqual([
      ['view', -1, 0],
      ['view', 1, 0],
      ['view', 0, -1],
      ['view', 0, 1],
      ['view', -1, 0],
    ]);
  });
});

describe('the active DOF', () => {
  it('the active DOF rotates by default, then is the chosen one, by name on the next joint', () => {
    const { wb, press } = posing();
    wb.store.select({ characterId: 'c1', joint: 0 });
    // tx ty tz of the root come first.
    expect(activeDof(wb)).toBe(3);
    press('V', 'viewport');
    expect(activeDof(wb)).toBe(4);
    wb.store.select({ characterId: 'c1', joint: 1 });
    expect(activeDof(wb)).toBe(7);
    press('Shift+V', 'viewport');
    press('Shift+V', 'viewport');
    expect(activeDof(wb)).toBe(8);
  });

  it('plus and minus say the new value, and the limit that stops it', () => {
    const [hips, leg, foot] = armature.joints;
    const limit = { min: -Math.PI / 120, max: Math.PI / 120 };
    const limited = { ...leg, limits: [limit, ...leg.limits.slice(1)] };
    const { wb, press } = posing({ skeleton: { ...armature, joints: [hips, limited, foot] } });
    wb.store.select({ characterId: 'c1', joint: 1 });
    press('+', 'viewport');
    expect(wb.messages.passing.get()).toBe('leg rx 1.0°');
    for (const _again of [2, 3]) {
      press('+', 'viewport');
      expect(wb.messages.passing.get()).toBe('leg rx 1.5°, limit 1.5°');
    }
    wb.settings.update((now) => ({ ...now, angles: 'radians' }));
    press('-', 'viewport');
    expect(wb.messages.passing.get()).toBe('leg rx 0.009 rad');
  });

  it('no DOF is active without a joint, nor a linked one', () => {
    const { wb } = posing();
    expect(activeDof(wb)).toBeUndefined();
    const couples = [{ dof: 'rx', joint: 0, follows: 'rx', gain: 1, offset: 0 }];
    const tied = { ...armature, joints: [armature.joints[0], { ...joint('leg', 0), couples }, armature.joints[2]] };
    const { wb: coupled } = posing({ skeleton: tied });
    coupled.store.select({ characterId: 'c1', joint: 1 });
    expect(activeDof(coupled)).toBe(7);
    chooseDof(coupled, 6);
    expect(activeDof(coupled)).toBe(7);
    const selected = selectedJoint(coupled);
    expect(selected && dofsByHand(selected)).toEqual([7, 8]);
  });

  it('keys change the active DOF by a degree, each in an undo step', () => {
    const { wb, press } = posing();
    wb.store.select({ characterId: 'c1', joint: 1 });
    press('+', 'viewport');
    press('+', 'viewport');
    press('-', 'viewport');
    expect(wb.store.document.characters[0].pose[6]).toBeCloseTo(Math.PI / 180, 12);
    expect(wb.store.undoLabel).toBe('Rotate leg (rx)');
  });
});
