/**
 * All details of what is selected. Rebuilt for another joint or vertex, and updated while the character moves: ten
 * times a second at most, and only while visible.
 */
import { sameValue } from '../../../edit/delta.ts';
import { tipPosition } from '../../../evaluate/end-sites.ts';
import { compileSkeleton, localMatrices } from '../../../evaluate/kinematics.ts';
import { isVisible } from '../../../evaluate/visible-points.ts';
import { determinant3 } from '../../../math/mat4.ts';
import { type Character, DEFAULT_PLACEMENT, findCharacter, shownSkin } from '../../../model/document.ts';
import { motionText } from '../../../model/joint-types/texts.ts';
import { movedVertices } from '../../../model/moved-vertices.ts';
import { firstDofs, rootDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { dofsOf, isPoint } from '../../../model/skeleton/joint-types.ts';
import { UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { shownPerUnit, withoutNoise } from '../../state/joints/angles.ts';
import type { Uses } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';
import { exact, plural, shown } from '../../widgets/numbers/number-text.ts';
import { endSiteTables } from './end-site-facts.ts';
import { FactList, type FactView } from './fact-list.ts';
import { vertexFacts } from './vertex-facts.ts';

export interface JointFacts {
  readonly element: HTMLElement;
  /** Call after an edit or a change of selection. */
  show(): void;
  /** Call when the time has changed. */
  fill(): void;
}

export function jointFacts(wb: Uses<'store' | 'viewport' | 'settings'>): JointFacts {
  const holder = element('div', { class: 'facts-holder' });
  let view: FactView | undefined;
  let key: readonly unknown[] = [];
  let inView = false;
  const fill = () => {
    if (inView) view?.fill();
  };
  new IntersectionObserver((entries) => {
    inView = entries.at(-1)?.isIntersecting ?? false;
    fill();
  }).observe(holder);

  const show = () => {
    const character = currentCharacter(wb);
    const { joint, vertex, characterId } = wb.store.selection;
    const own = character && characterId === character.id;
    const skin = character && shownSkin(character);
    const nextKey = [
      character?.id,
      own ? joint : undefined,
      own ? vertex : undefined,
      character?.skeleton,
      skin,
      wb.settings.get().angles,
      character?.clampsToLimits,
    ];
    if (nextKey.some((part, i) => part !== key[i]) || !view) {
      key = nextKey;
      view = makeView(wb, character, own ? joint : undefined, own ? vertex : undefined);
      holder.replaceChildren(view.element);
    }
    fill();
  };
  return { element: holder, show, fill };
}

function makeView(
  wb: Uses<'store' | 'viewport' | 'settings'>,
  character: Character | undefined,
  joint: number | undefined,
  vertex: number | undefined,
): FactView {
  const skin = character && shownSkin(character);
  if (character && skin && vertex !== undefined) return vertexFacts(wb, character, skin, vertex);
  if (character?.skeleton && joint !== undefined && character.skeleton.joints[joint]) {
    return factsOfJoint(wb, character, joint);
  }
  // The section is hidden.
  return { element: element('div'), fill: () => {} };
}

function factsOfJoint(wb: Uses<'store' | 'viewport' | 'settings'>, character: Character, index: number): FactView {
  const { skeleton, id } = character;
  if (!skeleton) throw new Error('A joint without a skeleton.');
  const joint = skeleton.joints[index];
  const list = new FactList(jointName(skeleton, index));
  list.fact('Index', `${index} (0–${skeleton.joints.length - 1})`);
  list.fact('Type', motionText(joint.motion, shown), motionText(joint.motion, exact));
  if (isPoint(joint.motion)) return factsOfPoint(wb, character, index, list);
  list.fact('Parent', joint.parent < 0 ? 'none (root)' : parentLink(wb, character, joint.parent));
  if (joint.length !== undefined) list.fact('Bone', shown(joint.length), exact(joint.length));
  list.grid({ label: 'Offset', rows: 1, columns: 3, columnLabels: ['x', 'y', 'z'] }).grid.setRow(0, joint.offset);

  const fillEnds = endSiteTables(skeleton, index, list);
  const dofs = dofTable(wb, character, index, list);
  const local = list.grid({ label: 'Local matrix', rows: 4, columns: 4 });
  const world = list.grid({ label: 'World matrix', rows: 4, columns: 4 });
  const { length } = joint;
  const columnLabels = ['x', 'y', 'z'];
  const tip =
    length === undefined ? undefined : list.grid({ label: 'Tip in world', rows: 1, columns: 3, columnLabels });
  const skin = shownSkin(character);
  if (skin && index < skin.bindings.length / 16) {
    const binding = list.grid({ label: 'Binding matrix', rows: 4, columns: 4 });
    binding.grid.setMatrix(skin.bindings, 16 * index);
    binding.note(mirrorText(skin.bindings, 16 * index));
  }
  if (skin) list.fact('Moves', plural(movedVertices(skin, index), 'vertex', 'vertices'));

  const locals = new Float64Array(16 * skeleton.joints.length);
  const fill = () => {
    const facts = wb.viewport.character(id);
    if (!facts) return;
    dofs(facts.dofs);
    localMatrices(compileSkeleton(skeleton), facts.dofs, locals);
    local.grid.setMatrix(locals, 16 * index);
    const worlds = facts.worldMatrices();
    world.grid.setMatrix(worlds, 16 * index);
    const now = findCharacter(wb.store.document, id) ?? character;
    world.note([mirrorText(worlds, 16 * index), placeText(now)].filter(Boolean).join(', '));
    if (length !== undefined) tip?.grid.setRow(0, tipPosition(length, worlds, index));
    fillEnds(worlds, facts.dofs);
  };
  return { element: list.element, fill };
}

/** A point has nothing but its place. */
function factsOfPoint(wb: Uses<'viewport'>, { id, skeleton }: Character, index: number, list: FactList): FactView {
  const place = list.grid({ label: 'Position', rows: 1, columns: 3, columnLabels: ['x', 'y', 'z'] });
  const fill = () => {
    const facts = wb.viewport.character(id);
    if (!facts || !skeleton) return;
    place.grid.setRow(0, facts.worldMatrices().subarray(16 * index + 12, 16 * index + 15));
    place.note(
      isVisible(compileSkeleton(skeleton), index, facts.dofs) ? '' : 'missing in this frame: where it was last',
    );
  };
  return { element: list.element, fill };
}

/** Value and limits of each DOF. Returns a function that fills in the values. */
function dofTable(wb: Uses<'settings'>, character: Character, index: number, list: FactList) {
  const { skeleton } = character;
  const joint = skeleton?.joints[index];
  if (!skeleton || !joint) return () => {};
  const own = dofsOf(joint.motion);
  if (!own.length) return () => {};
  const { angles } = wb.settings.get();
  const first = firstDofs(skeleton)[index];
  const root = index === 0 ? rootDofs(skeleton) : [];
  const rootRows = root.length;
  const rows = [...root, ...own];
  const { grid, note } = list.grid({
    label: 'DOFs',
    rows: rows.length,
    columns: 3,
    rowLabels: rows.map((dof) => dof.name),
    columnLabels: ['value', 'min', 'max'],
  });
  note(rows.some((dof) => dof.unit === 'angle') ? angles : '');
  own.forEach((dof, i) => {
    const limit = joint.limits[i];
    const factor = shownPerUnit(dof.unit, angles);
    grid.set(rootRows + i, 1, limit.min <= UNLIMITED.min ? -Infinity : withoutNoise(limit.min * factor));
    grid.set(rootRows + i, 2, limit.max >= UNLIMITED.max ? Infinity : withoutNoise(limit.max * factor));
  });
  for (let i = 0; i < rootRows; i++) {
    grid.set(i, 1, -Infinity);
    grid.set(i, 2, Infinity);
  }
  return (dofs: Float64Array) => {
    rows.forEach((dof, i) => {
      const at = i < rootRows ? i : first + i - rootRows;
      grid.set(i, 0, withoutNoise(dofs[at] * shownPerUnit(dof.unit, angles)));
    });
  };
}

function parentLink(wb: Uses<'store'>, character: Character, parent: number): HTMLElement {
  const { skeleton } = character;
  const name = jointName(skeleton, parent);
  const text = skeleton?.joints[parent]?.name ? `${name} (${parent})` : name;
  const made = element('button', { type: 'button', class: 'link' }, text);
  made.addEventListener('click', () => wb.store.select({ characterId: character.id, joint: parent }));
  return made;
}

/** World matrices are in the character's own world: notes where that is not the scene's. */
export function placeText({ placements }: Character): string {
  return placements.every((one) => sameValue(one, DEFAULT_PLACEMENT)) ? '' : 'without its place in the scene';
}

/** Notes a mirroring matrix, which flips normals and winding. */
function mirrorText(matrix: Float64Array, offset: number): string {
  const determinant = determinant3(matrix, offset);
  return determinant < 0 ? `mirrored, determinant ${shown(determinant)}` : '';
}
