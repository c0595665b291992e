/**
 * How a character's own space maps to the scene, in the character's section: up axis, unit, ground, and the meaning of
 * BVH position channels.
 *
 * Another unit or up axis puts the character back on the ground: after a correction it should be grounded.
 */
import type { GUI } from 'lil-gui';
import { alike, setPositionChannels, setSpace } from '../../../edit/commands/spaces.ts';
import { liftOntoGround } from '../../../evaluate/space/space.ts';
import { guessSpace, metresForPerson } from '../../../evaluate/space/space-guess.ts';
import { type Character, findCharacter, shownTake } from '../../../model/document.ts';
import { type Positions, positionsTaken } from '../../../model/skeleton/position-channels.ts';
import { DEFAULT_SPACE, type LengthUnit, type Space } from '../../../model/space.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { withoutNoise } from '../../state/joints/angles.ts';
import type { Uses } from '../../state/workbench.ts';
import { Slider, showIn } from '../../widgets/numbers/slider.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

const UNITS: readonly (readonly [string, LengthUnit | 'automatic'])[] = [
  ['Automatic', 'automatic'],
  ['As is', 'asIs'],
  ['Metres', 'metres'],
  ['Decimetres', 'decimetres'],
  ['Centimetres', 'centimetres'],
  ['Millimetres', 'millimetres'],
  ['Inches', 'inches'],
  ['CMU (1/0.45 in)', 'cmu'],
  ['Human height', 'own'],
];
const UPS = { 'y up': 'y', 'z up': 'z', 'y down': '-y' } as const;
const POSITIONS: Readonly<Record<string, Positions>> = { 'Replace the offset': 'replace', 'Add to it': 'add' };

/** Adds the rows to an empty section. Returns a function that updates their values. */
export function addSpaceRows(
  wb: Uses<'store' | 'viewport' | 'messages'>,
  edit: HandEdit,
  section: GUI,
  { id }: Character,
): () => void {
  const now = () => findCharacter(wb.store.document, id);
  const spaceNow = () => now()?.space ?? DEFAULT_SPACE;
  const put = (space: Space) => {
    const args = { characterId: id, space, ofSkeleton: binding.all };
    if (now()) attempt(wb.messages, () => wb.store.apply(setSpace, args));
    update();
    // A hundred times larger it is out of view, a hundred times smaller a speck.
    wb.viewport.camera.reveal(id);
  };
  const binding: { up: Space['up']; unit: LengthUnit | 'automatic'; positions: Positions; all: boolean } = {
    up: spaceNow().up,
    unit: spaceNow().unit,
    positions: 'replace',
    all: true,
  };
  const up = section.add(binding, 'up', UPS).name('Up axis');
  up.onChange((axis: Space['up']) => put(grounded(now(), { ...spaceNow(), up: axis })));

  const unit = section.add(binding, 'unit', Object.fromEntries(UNITS)).name('Unit');
  unit.onChange((chosen: LengthUnit | 'automatic') => {
    const character = now();
    const { up } = spaceNow();
    if (chosen === 'automatic') {
      put(character?.skeleton ? guessSpace(character.skeleton, shownTake(character)) : DEFAULT_SPACE);
    } else if (chosen === 'own') {
      const metres = character?.skeleton ? metresForPerson(character.skeleton, shownTake(character), up) : 1;
      put(grounded(character, { up, unit: 'own', metres, lift: 0 }));
    } else put(grounded(character, { up, unit: chosen, lift: 0 }));
  });

  const refuse = (reason: string) => {
    if (!edit.cancelled) wb.messages.note(reason, 'warning');
  };
  const lift = new Slider(section, 'Lift', spaceNow().lift, { step: 0.001, decimals: 3, suffix: ' m' }, refuse);
  lift.onChange((value: number) =>
    edit.preview(setSpace, { characterId: id, space: { ...spaceNow(), lift: value }, ofSkeleton: binding.all }),
  );
  lift.onTakenBack(() => edit.cancel());
  lift.onFinishChange(() => {
    edit.commit();
    update();
    wb.viewport.camera.reveal(id);
  });
  const character = now();
  if (character?.skeleton) {
    const ground = () => put(onGround(now(), spaceNow()));
    section.add({ ground }, 'ground').name('Put feet on the ground');
  }
  const all = section.add(binding, 'all').name('All takes of this skeleton');
  setTooltip(all.domElement, 'Up axis, unit and lift are set for all characters with this skeleton');
  const taken = character?.skeleton && positionsTaken(character.skeleton);
  const positions = taken && section.add(binding, 'positions', POSITIONS).name('Positions');
  positions?.onChange((meaning: Positions) => {
    attempt(wb.messages, () => wb.store.apply(setPositionChannels, { characterId: id, positions: meaning }));
  });

  const update = () => {
    const character = now();
    if (!character) return;
    const space = spaceNow();
    all.show(alike(wb.store.document, id).length > 0);
    showIn(up, space.up);
    showIn(unit, space.unit);
    lift.showValue(withoutNoise(space.lift));
    if (positions) showIn(positions, (character.skeleton && positionsTaken(character.skeleton)) ?? 'replace');
  };
  update();
  return update;
}

/** *As is* leaves everything as in the file, the height too. */
function grounded(character: Character | undefined, space: Space): Space {
  return space.unit === 'asIs' ? { ...space, lift: 0 } : onGround(character, space);
}

function onGround(character: Character | undefined, space: Space): Space {
  if (!character?.skeleton) return { ...space, lift: 0 };
  return { ...space, lift: liftOntoGround(character.skeleton, shownTake(character), space) };
}
