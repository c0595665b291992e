import { describe, expect, it } from 'vitest';
import { addAttachment, putDown } from '../../../../src/edit/commands/beside/attach.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import type { Character } from '../../../../src/model/document.ts';
import { ATTACH_ACTIONS } from '../../../../src/ui/editors/attach/actions.ts';
import { argsOf, attachUntil, choiceOf, meantBy } from '../../../../src/ui/editors/attach/dialog.ts';
import { detachNow, putDownNow } from '../../../../src/ui/editors/attach/edits.ts';
import { tellFollows } from '../../../../src/ui/editors/posing/tell-follows.ts';
import { followsAt, followsText } from '../../../../src/ui/editors/retarget/moved-text.ts';
import { dopeRows } from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

const BODY = skeleton(['hips', -1], ['hand', 0]);
const walker = character({ id: 'w', name: 'walker', skeleton: BODY, takes: [take([0, 1])], shownTake: 0 });
const sword = character({ id: 's', name: 'sword', skeleton: skeleton(['hilt', -1]) });
const GRIP = { characterId: 's', leaderId: 'w', joint: 1, span: [0.5, 2] as [number, number] };

const attached = () => {
  const { wb } = workbench(documentOf(walker, sword));
  wb.store.apply(addAttachment, GRIP);
  wb.store.select({ characterId: 's' });
  return wb;
};
const swordIn = (wb: ReturnType<typeof attached>) => wb.store.document.characters[1];
const spansOf = (one: Character) => one.takes[0].attached?.list.map(({ span }) => span);
const spans = (wb: ReturnType<typeof attached>) => spansOf(swordIn(wb));

describe('attaching on the page', () => {
  it('means the selected joint below a root as the one to follow, else the first other character', () => {
    const document = documentOf(walker, sword);
    expect(meantBy(document, { characterId: 'w', joint: 1 }, walker)).toEqual({
      follower: sword,
      leader: { id: 'w', joint: 1 },
    });
    expect(meantBy(document, { characterId: 's', joint: 0 }, sword)).toEqual({
      follower: sword,
      leader: { id: 'w', joint: 0 },
    });
    expect(meantBy(documentOf(sword), {}, sword)).toEqual({ follower: sword, leader: undefined });
  });

  it('by the dialog is put down where it ends within the takes, as by hand, and is held to their end otherwise', () => {
    const from = documentOf(
      { ...walker, takes: [take([0, 2], { ...channel(0, 1, 2), values: Float64Array.of(0, 1, 3) })] },
      { ...sword, timeOffsetSeconds: 0.3 },
    );
    const asked = { follower: 's', joint: choiceOf('w', 1), from: 0.5 };
    const by = (until: number) => argsOf(from, { ...asked, until });
    const { wb } = workbench(from);
    wb.store.apply(attachUntil, by(1.2));
    expect(wb.store.undoLabel).toBe('Attach sword to hand');
    const hand = workbench(from).wb.store;
    hand.apply(attachUntil, by(2));
    expect(spansOf(hand.document.characters[1])).toEqual([[0.8, 3.3]]);
    hand.apply(putDown, { characterId: 's', timeSeconds: 1.2 });
    expect(wb.store.document.characters[1].takes[0].channels).toEqual(hand.document.characters[1].takes[0].channels);
    expect(wb.store.document.characters[1].takes[0].channels[0].kind).toBe('keys');
    expect(spansOf(wb.store.document.characters[1])).toEqual([[0.8, 1.5]]);
    wb.store.undo();
    expect(wb.store.document).toBe(from);
    // What begins at that time takes it over.
    wb.store.apply(addAttachment, { characterId: 's', leaderId: 'w', joint: 0, span: [1.5, 3] });
    wb.store.apply(attachUntil, by(1.2));
    expect(spansOf(wb.store.document.characters[1])).toEqual([
      [0.8, 1.5],
      [1.5, 3],
    ]);
    expect(() => by(0.5)).toThrow('It must begin before it ends.');
  });

  it('is put down at the current time, and detached', () => {
    const wb = attached();
    wb.transport.update((p) => ({ ...p, timeSeconds: 1.25 }));
    putDownNow(wb);
    expect(spans(wb)).toEqual([[0.5, 1.25]]);
    detachNow(wb);
    expect(spans(wb)).toBeUndefined();
  });

  it('what else was posed by hand stays when it is put down', () => {
    const { wb } = workbench(documentOf(walker, { ...sword, skeleton: skeleton(['hilt', -1], ['tassel', 0]) }));
    wb.store.apply(addAttachment, GRIP);
    wb.store.apply(setDofs, { characterId: 's', dofs: [{ index: 7, value: 1 }], timeSeconds: 0, key: {} });
    const dofs = [1, 7].map((index) => ({ index, value: 2 }));
    wb.store.apply(setDofs, { characterId: 's', dofs, timeSeconds: 1.25 });
    wb.store.apply(putDown, { characterId: 's', timeSeconds: 1.25 });
    expect(swordIn(wb).unkeyed).toEqual({ timeSeconds: 1.25, dofs: [7], values: [2] });
  });

  it('is told by the time, and put down only where it is held', () => {
    const wb = attached();
    const at = (time: number) => {
      wb.transport.update((p) => ({ ...p, timeSeconds: time }));
      const refused = ATTACH_ACTIONS.find(({ id }) => id === 'character.putDown')?.refuses?.(wb);
      return [followsAt(swordIn(wb), time), refused !== undefined];
    };
    expect(at(0.2)).toEqual(['Follows walker’s hand from 0.50 s', true]);
    expect(at(1.2)).toEqual(['Follows walker’s hand', false]);
    putDownNow(wb);
    expect(at(1.2)).toEqual(['Followed walker’s hand until 1.20 s', false]);
    expect(at(1.5)).toEqual(['Followed walker’s hand until 1.20 s', true]);
  });

  it('is told where the character is listed, and has a row in the dope sheet, with keys or without', () => {
    const wb = attached();
    expect(followsText(swordIn(wb))).toBe('follows walker');
    const options = { unfolded: [], all: false, filter: '' };
    expect(dopeRows(swordIn(wb), swordIn(wb).takes[0], options).map(({ label }) => label)).toEqual([
      '',
      'Follows hand of walker',
    ]);
  });

  it('a message, once, says that posing the root has no effect', () => {
    const wb = attached();
    tellFollows(wb, swordIn(wb), [0]);
    expect(wb.messages.passing.get()).toMatch(/^The root of sword follows another character/);
    wb.messages.passing.set(undefined);
    tellFollows(wb, swordIn(wb), [4]);
    expect(wb.messages.passing.get()).toBeUndefined();
  });
});
