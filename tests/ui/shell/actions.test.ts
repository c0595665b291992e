import { describe, expect, it } from 'vitest';
import { ACTIONS } from '../../../src/ui/shell/actions.ts';
import { findActions, searchActions, searchDofs, searchJoints } from '../../../src/ui/shell/help/command-search.ts';
import { actionsOf, findAction, isEnabled, reasonNot, runAction } from '../../../src/ui/state/actions/action.ts';
import { GROUPS, MENUS } from '../../../src/ui/state/menus.ts';
import { capture, channel, character, documentOf, skeleton, take, workbench } from '../builders.ts';

describe('the list of actions', () => {
  it('the list of actions has no id twice', () => {
    const ids = ACTIONS.map((a) => a.id);
    expect(new Set(ids).size).toBe(ids.length);
  });

  it('the list of actions has no key twice in one panel', () => {
    const taken = ACTIONS.flatMap((a) => (a.shortcuts ?? []).map((key) => `${a.panel ?? 'page'} ${key}`));
    expect(taken.filter((key, i) => taken.indexOf(key) !== i)).toEqual([]);
  });

  it('leaves the keys that browsers keep to themselves', () => {
    const theirs = ['Ctrl+T', 'Ctrl+N', 'Ctrl+W', 'Ctrl+Tab', 'Ctrl+Shift+T', 'Ctrl+Shift+N'];
    expect(ACTIONS.flatMap((a) => a.shortcuts ?? []).filter((key) => theirs.includes(key))).toEqual([]);
  });

  it('puts every action into a menu that exists, or gives it a key', () => {
    for (const action of ACTIONS) {
      const menu = action.menu?.split('/')[0];
      if (menu) expect(MENUS).toContain(menu);
      else expect(action.shortcuts?.length, action.id).toBeGreaterThan(0);
      expect(GROUPS).toContain(action.group);
    }
  });

  it('the list of actions fills every menu', () => {
    const { wb } = workbench();
    for (const menu of MENUS) expect(actionsOf(wb).some((a) => a.menu?.split('/')[0] === menu)).toBe(true);
  });

  it('the list of actions has the page’s examples', () => {
    const { wb } = workbench();
    const ids = actionsOf(wb).map((a) => a.id);
    expect(ids).toContain('sample.walker');
  });

  it('the list of actions has sessions left by an earlier page, as long as there are any', () => {
    const { wb } = workbench();
    const inMenu = () => actionsOf(wb).find((a) => a.id === 'session.restore');
    expect(inMenu()).toBeUndefined();
    const asked: string[] = [];
    const works = [{ id: 's1', savedAtMs: 0, characters: [{ name: 'wasp', joints: 31, takes: 1 }] }];
    const no = () => {};
    const answers = {
      restore: no,
      discard: no,
      putBack: no,
      choose: no,
      later: no,
      again: () => void asked.push('s1'),
    };
    wb.kept.set({ works, isAside: false, isPutOff: true, isAskedFor: false, ...answers });
    expect(inMenu()?.detail).toContain('wasp, 31 joints');
    runAction(wb, 'session.restore');
    expect(asked).toEqual(['s1']);
    wb.kept.set({ works: [], isAside: false, isPutOff: true, isAskedFor: false, ...answers });
    expect(inMenu()).toBeUndefined();
  });

  it('the list of actions can be queried without a character', () => {
    const { wb } = workbench();
    for (const action of actionsOf(wb)) {
      expect(() => [action.refuses?.(wb), action.checked?.(wb)], action.id).not.toThrow();
    }
  });
});

describe('runAction', () => {
  const walker = () =>
    workbench(
      documentOf(
        character({
          skeleton: skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0]),
          takes: [take([0, 2], channel(0, 0.5, 1))],
        }),
      ),
      { range: [0, 2] },
    );

  it('reports an unknown or disabled action', () => {
    const { wb } = workbench();
    expect(() => runAction(wb, 'nothing.atAll')).toThrow('no action');
    expect(() => runAction(wb, 'edit.undo')).toThrow('is not available');
  });

  it('steps from joint to joint', () => {
    const { wb } = walker();
    const joints = ['select.parent', 'select.child', 'select.nextSibling', 'select.child', 'select.parent'].map(
      (id) => {
        runAction(wb, id);
        return wb.store.selection.joint;
      },
    );
    // The root; its first child; that one's sibling, which has no child; and its parent.
    expect(joints).toEqual([0, 1, 3, 3, 0]);
  });

  it('runAction goes from key to key and stops there', () => {
    const { wb } = walker();
    runAction(wb, 'play.toggle');
    runAction(wb, 'play.nextKey');
    expect(wb.transport.get()).toMatchObject({ timeSeconds: 0.5, playing: false });
    runAction(wb, 'play.nextKey');
    runAction(wb, 'play.nextKey');
    expect(wb.transport.get().timeSeconds).toBe(1);
    runAction(wb, 'play.previousKey');
    expect(wb.transport.get().timeSeconds).toBe(0.5);
  });

  it('pauses on a frame if times snap to frames, whatever they are shown in, else at the time that is shown', () => {
    const { wb } = walker();
    for (const [timeDisplay, snapsToFrames, pausedAt] of [
      ['seconds', true, 21 / 30],
      ['frames', true, 21 / 30],
      ['seconds', false, 0.71],
      ['frames', false, 0.71],
    ] as const) {
      wb.timeline.change({ snapsToFrames });
      wb.settings.update((s) => ({ ...s, timeDisplay }));
      wb.transport.update((p) => ({ ...p, timeSeconds: 0.71, playing: true }));
      runAction(wb, 'play.toggle');
      expect(wb.transport.get()).toMatchObject({ playing: false, timeSeconds: pausedAt });
    }
  });

  it('pauses on a frame of a capture, whether or not times snap to frames', () => {
    const { wb } = workbench(
      documentOf(character({ skeleton: skeleton(['hips', -1]), takes: [capture(6, 0.1, 101)] })),
    );
    wb.timeline.change({ snapsToFrames: false });
    wb.transport.update((p) => ({ ...p, framesPerSecond: 10, timeSeconds: 0.71, range: [0, 10], playing: true }));
    runAction(wb, 'play.toggle', 'key');
    expect(wb.transport.get()).toMatchObject({ playing: false, timeSeconds: 0.7 });
  });

  it('removes the message of a step when undone', () => {
    const { wb } = walker();
    runAction(wb, 'pose.holdLimits');
    for (const way of ['edit.undo', 'edit.redo']) {
      wb.messages.note('Said of a step.');
      runAction(wb, way);
      expect(wb.messages.passing.get()).toBeUndefined();
    }
  });

  it('sets the range at the current time, and back to the takes', () => {
    const { wb } = walker();
    wb.transport.update((p) => ({ ...p, timeSeconds: 3 }));
    runAction(wb, 'play.setIn');
    expect(wb.transport.get().range).toEqual([3, 3]);
    runAction(wb, 'play.wholeRange');
    expect(wb.transport.get().range).toEqual([0, 2]);
  });

  it('names a reset in undo', () => {
    const { wb } = walker();
    runAction(wb, 'pose.holdLimits');
    expect(wb.store.document.characters[0].clampsToLimits).toBe(false);
    const undo = actionsOf(wb).find((a) => a.id === 'edit.undo');
    expect(typeof undo?.label === 'function' && undo.label(wb)).toBe('Undo ignore limits of wasp');
    runAction(wb, 'edit.undo');
    expect(wb.store.document.characters[0].clampsToLimits).toBe(true);
  });

  it('collapses panels, one by one and together', () => {
    const { wb } = workbench();
    const open = () => {
      const { outlinerOpen, inspectorOpen } = wb.settings.get().panels;
      return [outlinerOpen, inspectorOpen];
    };
    const after = ['page.outliner', 'page.viewportOnly', 'page.viewportOnly', 'page.inspector'].map((id) => {
      runAction(wb, id);
      return open();
    });
    expect(after).toEqual([
      [false, true],
      [false, false],
      [true, true],
      [true, false],
    ]);
  });

  it('saves what the character has', () => {
    const { wb, saved } = walker();
    runAction(wb, 'save.skel');
    expect(saved).toEqual(['c1.skel']);
    expect(() => runAction(wb, 'save.skin')).toThrow();
  });
});

describe('searchActions', () => {
  const posed = () => workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['leg', 0]) })));

  it('the search lists commands that are disabled behind the others, each with its reason', () => {
    const { wb } = posed();
    const found = searchActions(wb, 'pin');
    const enabled = found.map((action) => isEnabled(wb, action));
    expect(enabled).toContain(false);
    expect(enabled).toEqual([...enabled].sort().reverse());
    for (const action of found) if (!isEnabled(wb, action)) expect(reasonNot(wb, action)).toMatch(/\.$/);
    expect(searchActions(wb, '').every((action) => isEnabled(wb, action))).toBe(true);
  });

  it('the search finds playing by the words of the list of shortcuts', () => {
    expect(searchActions(posed().wb, 'play or pause')[0]?.id).toBe('play.toggle');
  });

  it.each(['rotate', 'turn'])('the search finds the keys that %s a joint', (word) => {
    expect(searchActions(posed().wb, word).map(({ id }) => id)).toEqual(
      expect.arrayContaining(['posing.more', 'posing.less']),
    );
  });
});

it('the search finds every command that can run by its name, whatever its label says it is for now', () => {
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['leg', 0]) })));
  wb.store.select({ characterId: wb.store.document.characters[0].id, joint: 1 });
  const named = actionsOf(wb).filter((action) => action.name !== undefined && isEnabled(wb, action));
  expect(named.length).toBeGreaterThan(10);
  for (const action of named) {
    expect(searchActions(wb, action.name ?? '').map(({ id }) => id)).toContain(action.id);
  }
});

it('the search begins with the command that is called exactly so', () => {
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1]) })));
  expect(searchActions(wb, 'compare')[0]?.id).toBe('page.tab.compare');
  expect(searchActions(wb, ' Compare ')[0]?.id).toBe('page.tab.compare');
});

describe('searchJoints', () => {
  const posed = () =>
    workbench(
      documentOf(character({ skeleton: skeleton(['hips', -1], ['arm_l', 0], ['arm_r', 0], ['forearm_l', 1]) })),
    );
  const labels = (typed: string) => searchJoints(posed().wb, typed).map(({ label }) => label);

  it('finds joints by any part of their names, those that begin so first', () => {
    expect(labels('arm_l')).toEqual(['Select arm_l', 'Select forearm_l']);
    expect(labels('joint hips')).toEqual(['Select hips']);
    expect(labels('wing')).toEqual([]);
    expect(labels(' ')).toEqual([]);
  });
});

it('the search finds the DOFs of the selected joint by their names, and a command that goes to a time', () => {
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['arm', 0]) })));
  expect(searchDofs(wb, 'rz')).toEqual([]);
  wb.store.select({ characterId: wb.store.document.characters[0].id, joint: 1 });
  expect(searchDofs(wb, ' RZ ').map(({ label }) => label)).toEqual(['Type rz of arm']);
  expect(searchDofs(wb, 'r')).toEqual([]);
  expect(searchActions(wb, 'time').map(({ id }) => id)).toContain('play.toTime');
  const labels = searchActions(wb, 'time').map((action) => action.id);
  expect(labels.indexOf('play.toTime')).toBeLessThan(labels.findIndex((id) => id.includes('delete')) >>> 0);
});

describe('findActions', () => {
  const found = (typed: string) =>
    findActions(['Frame all', 'Step one frame', 'Next key', 'Joint names'], typed, (label) => label);

  it('wants every word, anywhere', () => {
    expect(found('fra')).toEqual(['Frame all', 'Step one frame']);
    expect(found('frame st')).toEqual(['Step one frame']);
    expect(found('xyz')).toEqual([]);
    expect(found('')).toHaveLength(4);
  });

  it('puts words that begin so first', () => {
    expect(found('ame')).toEqual(['Frame all', 'Step one frame', 'Joint names']);
    expect(found('na')).toEqual(['Joint names']);
  });

  it('finds actions by other words too, behind those that are called so', () => {
    const theme = (typed: string) =>
      findActions(
        ['View Shadow', 'View Theme Light'],
        typed,
        (label) => label,
        () => false,
        (label) => (label === 'View Shadow' ? 'light ground' : ''),
      );
    expect(theme('light')).toEqual(['View Theme Light', 'View Shadow']);
    expect(theme('ground')).toEqual(['View Shadow']);
    expect(theme('view light')).toEqual(['View Theme Light', 'View Shadow']);
  });

  it('sorts actions to come last behind equal matches, but before worse ones', () => {
    const undoLast = (typed: string) =>
      findActions(
        ['Edit Undo', 'Edit Select', 'View Redo it', 'Keys Find redoubt'],
        typed,
        (label) => label,
        (label) => /Undo|Redo/.test(label),
      );
    expect(undoLast('edit')).toEqual(['Edit Select', 'Edit Undo']);
    expect(undoLast('redo')).toEqual(['Keys Find redoubt', 'View Redo it']);
    expect(undoLast('undo')).toEqual(['Edit Undo']);
    expect(undoLast('')[0]).toBe('Edit Undo');
  });
});

describe('what is drawn', () => {
  const styles = (...characters: Parameters<typeof documentOf>) => {
    const { wb } = workbench(documentOf(...characters));
    return {
      wb,
      enabled: (id: string) => {
        const action = findAction(wb, id);
        return action?.refuses?.(wb) === undefined;
      },
    };
  };
  const rig = skeleton(['hips', -1]);
  const capture = {
    ...rig,
    joints: rig.joints.map((j) => ({ ...j, motion: { kind: 'bvh', channels: [], positions: 'replace' } as const })),
  };

  it('offers skin and box styles only if a visible character has them', () => {
    const captures = styles(character({ skeleton: capture }));
    expect(['draw.skin.solid', 'draw.boxes.wire', 'draw.boxes.hidden'].map(captures.enabled)).toEqual([
      false,
      false,
      true,
    ]);
    const hidden = styles(character({ skeleton: capture }), character({ id: 'c2', skeleton: rig, isHidden: true }));
    expect(hidden.enabled('draw.boxes.wire')).toBe(false);
    const boxes = styles(character({ skeleton: capture }), character({ id: 'c2', skeleton: rig }));
    expect(boxes.enabled('draw.boxes.wire')).toBe(true);
    expect(styles().enabled('draw.skin.solid')).toBe(true);
  });

  it('what is drawn goes on to a box style that changes something', () => {
    const { wb } = styles(character({ skeleton: capture }));
    runAction(wb, 'draw.nextBoxes');
    expect(wb.settings.get().display.boxes).toBe('hidden');
    runAction(wb, 'draw.nextBoxes');
    expect(wb.settings.get().display.boxes).toBe('bare');
  });
});

it('removing a character says so, and the button beside it brings the character back', async () => {
  const { wb } = workbench(documentOf(character()));
  wb.store.select({ characterId: 'c1' });
  const before = wb.store.document;
  await actionsOf(wb)
    .find((action) => action.id === 'character.remove')
    ?.run(wb);
  expect(wb.store.document.characters).toEqual([]);
  expect(wb.messages.passing.get()).toBe('wasp was removed.');
  expect(wb.messages.offers[0]?.label).toBe('Undo');
  wb.messages.offers[0]?.run();
  expect(wb.store.document).toEqual(before);
});
