/** Sections of DOFs: the selected joints', the root translation, the morphs, and the list of all. */

import type { GUI } from 'lil-gui';
import { cutName } from '../../../edit/cut-name.ts';
import { matchingDofs } from '../../../edit/pose/same-change.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import { motionHeading, motionText } from '../../../model/joint-types/texts.ts';
import { type CharacterDof, characterDofs, firstDofs, rootDofCount } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { dofsOf } from '../../../model/skeleton/joint-types.ts';
import { activeLayer } from '../../../model/takes/layers.ts';
import { keyNameOf } from '../../state/actions/tooltips.ts';
import { jointsText } from '../../state/joints/selected-joint.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { removeControllers } from '../../widgets/numbers/slider.ts';
import { contentOf, isOpen, titleOf } from '../../widgets/section.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { isSampled } from '../posing/pose-edits.ts';
import { addDofRow, type DofRowContext } from './dof-rows.ts';

/** Rows of the long list are created in chunks of this size as it is scrolled. */
const CHUNK = 48;

export class DofSections {
  private readonly joint: GUI;
  private readonly root: GUI;
  private readonly morphs: GUI;
  private readonly all: GUI;
  private readonly note = element('p', { class: 'note unkeyed-note', hidden: true });
  /** End of the long list; scrolling it into view adds more rows. */
  private readonly end = element('div', { class: 'list-end' });
  private readonly endObserver: IntersectionObserver;
  private listed: { readonly character: Character; readonly dofs: readonly CharacterDof[]; next: number } | undefined;

  constructor(
    private readonly context: DofRowContext,
    gui: GUI,
    makeSection: (id: string, title: string, open: boolean) => GUI,
  ) {
    this.joint = makeSection('joint', 'Joint', true);
    this.root = makeSection('root', 'Root translation', true);
    this.morphs = makeSection('morphs', 'Morphs', true);
    this.all = makeSection('all', 'All DOFs', false);
    for (const section of [this.joint, this.root]) section.domElement.classList.add('short-names');
    this.morphs.domElement.classList.add('morph-names');
    this.all.domElement.classList.add('long-names');
    // At the bottom: inserting a line above would move the slider away from the pointer.
    gui.domElement.append(this.note);
    this.endObserver = new IntersectionObserver(
      (entries) => {
        if (entries.some((e) => e.isIntersecting)) this.listMore();
      },
      { root: contentOf(gui), rootMargin: '200px 0px' },
    );
    this.endObserver.observe(this.end);
  }

  /**
   * Rebuilds the rows, after the character, joints, angle unit or limits have changed.
   *
   * @param joints selected ones, the active one last
   */
  rebuild(character: Character | undefined, joints: readonly number[]): void {
    for (const section of [this.joint, this.root, this.morphs, this.all]) {
      for (const controller of section.controllers) this.context.live.remove(controller.domElement);
      removeControllers(section);
      section.show(character !== undefined);
    }
    const { listed } = this;
    this.listed = undefined;
    this.end.remove();
    if (!character) return;
    const dofs = characterDofs(character.skeleton, character.morphs);
    this.fillJoint(character, dofs, joints);
    const rootCount = character.skeleton ? rootDofCount(character.skeleton) : 0;
    this.fill(this.root, character, dofs, 0, rootCount);
    this.root.show(rootCount > 0);
    this.fillMorphs(character, dofs);
    this.all.show(character.skeleton !== undefined);
    this.all.title(`All DOFs (${dofs.length})`);
    this.listed = { character, dofs, next: 0 };
    contentOf(this.all).append(this.end);
    // As many rows as before, so that the scroll position can be restored.
    const until = listed?.character.id === character.id ? Math.min(listed.next, dofs.length) : 0;
    while (this.listed.next < until && isOpen(this.all)) this.listMore();
  }

  /** Shows at the bottom that unkeyed changes will be lost. */
  showUnkeyed(character: Character | undefined): void {
    const { unkeyed } = character ?? {};
    const { timeSeconds } = this.context.wb.transport.get();
    const count = unkeyed?.timeSeconds === timeSeconds ? unkeyed.dofs.length : 0;
    write(this.note, 'hidden', count === 0);
    if (!count) return;
    const key = keyNameOf(this.context.wb, 'key.changed');
    const what = plural(count, 'unkeyed change');
    const isAnySampled = character && unkeyed?.dofs.some((dof) => isSampled(character, dof));
    const keys = isAnySampled ? 'offers to convert sampled curves to keys' : `keys ${count === 1 ? 'it' : 'them'}`;
    const take = character && shownTake(character);
    const layer = take && activeLayer(take);
    const how = layer?.mute ? `. The layer “${layer.name}” is muted` : key ? `. ${key} ${keys}` : '';
    setText(this.note, `${what}, lost when the time changes${how}.`);
  }

  private fillJoint(character: Character, dofs: readonly CharacterDof[], joints: readonly number[]): void {
    const { skeleton } = character;
    const index = joints.at(-1);
    const joint = index === undefined ? undefined : skeleton?.joints[index];
    const others = joints.slice(0, -1);
    this.joint.show(skeleton !== undefined);
    const title = joint ? jointsText(skeleton, joints) : 'Joint';
    this.joint.title(cutName(title));
    setTooltip(titleOf(this.joint), cutName(title) === title ? undefined : title);
    this.joint.domElement.classList.toggle('is-selected', joint !== undefined);
    write(contentOf(this.joint).dataset, 'empty', 'Select a joint in the viewport or outliner to see its DOFs.');
    if (!joint || !skeleton || index === undefined) return;
    const heading = motionHeading(joint.motion, shown);
    const note = others.length ? `active: ${jointName(skeleton, index)}` : heading;
    // Also with a picked vertex, whose details replace the joint's below.
    titleOf(this.joint).append(element('span', { class: 'title-note' }, note));
    contentOf(this.joint).dataset.empty = others.length
      ? 'The selected joints have no degree of freedom in common.'
      : `${motionText(joint.motion, shown)}: no degrees of freedom.`;
    const first = firstDofs(skeleton)[index];
    for (let i = first; i < first + dofsOf(joint.motion).length; i++) {
      const matching = matchingDofs(skeleton, others, i);
      // Only those that all of them have.
      if (matching.length === others.length) addDofRow(this.context, this.joint, character, i, dofs[i], { matching });
    }
  }

  /** The first of them; the list of all has the rest. */
  private fillMorphs(character: Character, dofs: readonly CharacterDof[]): void {
    const count = character.morphs.length;
    this.morphs.show(count > 0);
    this.fill(this.morphs, character, dofs, dofs.length - count, Math.min(count, 2 * CHUNK));
  }

  private fill(section: GUI, character: Character, dofs: readonly CharacterDof[], first: number, count: number): void {
    for (let i = first; i < first + count; i++) addDofRow(this.context, section, character, i, dofs[i]);
  }

  private listMore(): void {
    const { listed } = this;
    if (!listed || !isOpen(this.all)) return;
    const { character, dofs } = listed;
    const joints = character.skeleton?.joints ?? [];
    const until = Math.min(dofs.length, listed.next + CHUNK);
    for (; listed.next < until; listed.next++) {
      const dof = dofs[listed.next];
      const joint = joints[dof.joint];
      const isRoot = listed.next < rootDofCount(character.skeleton);
      const prefix = isRoot ? 'root' : joint ? jointName(character.skeleton, dof.joint) : 'morph';
      addDofRow(this.context, this.all, character, listed.next, dof, { prefix });
    }
    // The end element stays last; moving it makes the observer check again.
    this.end.remove();
    if (listed.next < dofs.length) contentOf(this.all).append(this.end);
  }
}
