/**
 * From what is selected to the parts that a file's text may hold, and back: what a click on a line selects. Indices are
 * those of the file as it was opened.
 */

import { type Character, type Document, findCharacter, shownSkin, shownTake } from '../../../model/document.ts';
import type { SourceFile } from '../../../model/files.ts';
import type { PartMark, PartMarks } from '../../../model/part.ts';
import type { Selection } from '../../../model/session.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { isOfAcclaim } from '../../../model/skeleton/joint-types.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import type { Skin } from '../../../model/skin.ts';
import { boneKey, type SourceTarget } from '../../../model/source-map.ts';
import { keysOf } from '../../../model/takes/take.ts';

/** What a character has from a file. */
export interface FileParts {
  readonly character: Character;
  /** Which of the file's skeletons it has; absent: none. */
  readonly root?: number;
  /** The skin that is shown is in the file. */
  readonly hasSkin: boolean;
  readonly hasMorph: boolean;
  /** The take that is shown is in the file. */
  readonly hasTake: boolean;
}

/** A DOF that was chosen by hand. */
export interface ChosenDof {
  readonly characterId: string;
  /** Index into the character's DOFs. */
  readonly dof: number;
}

/** What clicking a line changes. */
export interface Picked {
  readonly selection: Selection;
  readonly dof?: ChosenDof & { readonly name: string };
  /** Time to go to, in seconds of the transport. */
  readonly timeSeconds?: number;
  /** In words. */
  readonly text: string;
}

/** The characters that have something from a file, in the order of the document. */
export function partsFrom({ characters }: Pick<Document, 'characters'>, path: string): readonly FileParts[] {
  let roots = 0;
  const found: FileParts[] = [];
  for (const character of characters) {
    const { parts } = character;
    const isFrom = (mark: PartMark | undefined) => mark?.file?.source.path === path;
    const root = isFrom(parts?.skeleton) ? rootOf(parts?.skeleton, roots++) : undefined;
    const hasSkin = isFrom(parts?.skins[character.shownSkin]);
    const hasMorph = parts?.morphs.some(isFrom) ?? false;
    const hasTake = isFrom(parts?.takes[character.shownTake]);
    if (root === undefined && !hasMorph && !hasPartFrom(parts, path)) continue;
    found.push({ character, ...(root !== undefined && { root }), hasSkin, hasMorph, hasTake });
  }
  return found;
}

/** Whether the selected character has something from a file. */
export function hasPartOfSelected(document: Document, { characterId }: Selection, path: string): boolean {
  const character = findCharacter(document, characterId);
  return character !== undefined && partsFrom({ characters: [character] }, path).length > 0;
}

/** Also what isn't shown, or has no lines that can be selected. */
function hasPartFrom(parts: PartMarks | undefined, path: string): boolean {
  const marks = parts ? [...parts.skins, ...parts.takes, parts.poses] : [];
  return marks.some((mark) => mark?.file?.source.path === path);
}

/** A `.skel` numbers its skeletons in their names, from the second one on; others are in the order of the document. */
function rootOf(mark: PartMark | undefined, order: number): number {
  const { file } = mark ?? {};
  if (file?.kind !== 'skel') return order;
  const [, number] = /_(\d+)$/.exec(file.holds) ?? [];
  const stem = file.source.name.replace(/\.[^.]*$/, '');
  return number !== undefined && file.holds === `${stem}_${number}` ? Number(number) - 1 : 0;
}

/** The parts of the selection that may be in a file, the one to be shown first. */
export function targetsOf(parts: FileParts, selection: Selection, chosen: ChosenDof | undefined): SourceTarget[] {
  const { character, root, hasSkin, hasMorph, hasTake } = parts;
  if (selection.characterId !== character.id) return [];
  const { vertex, keys } = selection;
  const joints = [...jointsIn(selection)].reverse();
  const dofs = characterDofs(character.skeleton, character.morphs);
  const dof = chosen?.characterId === character.id && dofs[chosen.dof]?.joint === joints[0] ? chosen.dof : undefined;
  const found: SourceTarget[] = [];
  if (vertex !== undefined && (hasSkin || hasMorph)) found.push({ kind: 'vertex', vertex });
  const skin = shownSkin(character);
  if (vertex !== undefined && hasSkin && skin) found.push(...trianglesOf(skin, vertex));
  if (keys?.length && hasTake) {
    for (const { channel, indices } of keys) for (const key of indices) found.push({ kind: 'key', channel, key });
  }
  for (const joint of joints) {
    if (root !== undefined) {
      const name = joint === joints[0] && dof !== undefined ? dofs[dof].name : undefined;
      found.push({ kind: 'joint', root, joint, ...(name !== undefined && { dof: name }) });
    }
    if (hasSkin) found.push({ kind: 'binding', joint });
    if (!hasTake || keys?.length) continue;
    const own = character.skeleton?.joints[joint];
    if (own && isOfAcclaim(own.motion)) found.push({ kind: 'bone', name: boneKey(own.name) });
    dofs.forEach((own, channel) => {
      const isMeant = dof === undefined || joint !== joints[0] || channel === dof;
      if (own.joint === joint && isMeant) found.push({ kind: 'channel', channel });
    });
  }
  return found;
}

function trianglesOf({ triangles }: Skin, vertex: number): SourceTarget[] {
  const found: SourceTarget[] = [];
  for (let at = triangles.indexOf(vertex); at >= 0; at = triangles.indexOf(vertex, at + 1)) {
    const triangle = Math.floor(at / 3);
    found.push({ kind: 'triangle', triangle });
    // A triangle that has it twice is one.
    at = 3 * triangle + 2;
  }
  return found;
}

/** The frame at a time; undefined without samples. */
export function frameAt({ character }: FileParts, timeSeconds: number): SourceTarget | undefined {
  const samples = shownTake(character)?.samples;
  if (!samples) return undefined;
  const own = timeSeconds + character.timeOffsetSeconds - samples.startSeconds;
  const frame = Math.round(own / samples.frameSeconds);
  return frame >= 0 && frame < samples.frameCount ? { kind: 'frame', frame } : undefined;
}

/** What a click on a part selects; undefined if the page doesn't have it any more. */
export function pickOf(parts: readonly FileParts[], target: SourceTarget): Picked | undefined {
  const found = parts.map((each) => pickIn(each, target)).filter((pick) => pick !== undefined);
  return found[0];
}

function pickIn(parts: FileParts, target: SourceTarget): Picked | undefined {
  const { character, root } = parts;
  const { skeleton } = character;
  const characterId = character.id;
  const own = characterDofs(skeleton, character.morphs);
  const name = (joint: number) => jointName(skeleton, joint);
  const isJoint = (joint: number) => skeleton?.joints[joint] !== undefined;
  switch (target.kind) {
    case 'joint': {
      const { joint } = target;
      if (target.root !== root || !isJoint(joint)) return undefined;
      const dof = own.findIndex((d) => d.joint === joint && d.takesLimits && d.name === target.dof);
      if (dof < 0) return { selection: { characterId, joint }, text: `Joint ${name(joint)}` };
      const chosen = { characterId, dof, name: own[dof].name };
      return { selection: { characterId, joint }, dof: chosen, text: `${name(joint)} ${own[dof].name}` };
    }
    case 'binding': {
      const { joint } = target;
      if (!parts.hasSkin || !isJoint(joint)) return undefined;
      return { selection: { characterId, joint }, text: `Binding of ${name(joint)}` };
    }
    case 'vertex':
    case 'triangle': {
      const skin = shownSkin(character);
      if (!skin || !(parts.hasSkin || (parts.hasMorph && target.kind === 'vertex'))) return undefined;
      const vertex = target.kind === 'vertex' ? target.vertex : skin.triangles[3 * target.triangle];
      if (vertex === undefined || 3 * vertex >= skin.positions.length) return undefined;
      const text = target.kind === 'vertex' ? `Vertex ${vertex}` : triangleText(skin, target.triangle);
      return { selection: { characterId, vertex }, text };
    }
    case 'channel':
    case 'key':
      return parts.hasTake ? pickInChannel(character, target) : undefined;
    case 'frame': {
      const samples = shownTake(character)?.samples;
      if (!parts.hasTake || !samples || target.frame >= samples.frameCount) return undefined;
      const at = samples.startSeconds + target.frame * samples.frameSeconds - character.timeOffsetSeconds;
      return { selection: { characterId }, timeSeconds: at, text: `Frame ${target.frame}` };
    }
    case 'bone': {
      const joint = skeleton?.joints.findIndex((each) => boneKey(each.name) === target.name) ?? -1;
      const frame = pickIn(parts, { kind: 'frame', frame: target.frame ?? 0 });
      return joint < 0 || !frame
        ? undefined
        : { ...frame, selection: { characterId, joint }, text: `${name(joint)} in frame ${target.frame}` };
    }
  }
}

/** One vertex can be selected: its first one is. */
function triangleText({ triangles }: Skin, triangle: number): string {
  const corners = triangles.subarray(3 * triangle, 3 * triangle + 3);
  return `Triangle ${triangle}: vertices ${corners.join(' ')}, ${corners[0]} selected`;
}

function pickInChannel(
  character: Character,
  target: Extract<SourceTarget, { readonly kind: 'channel' | 'key' }>,
): Picked | undefined {
  const { channel } = target;
  const characterId = character.id;
  const driven = shownTake(character)?.channels[channel];
  if (!driven) return undefined;
  const dof = characterDofs(character.skeleton, character.morphs)[channel];
  const joint = dof && dof.joint >= 0 ? dof.joint : undefined;
  const of = joint === undefined ? `channel ${channel}` : `${jointName(character.skeleton, joint)} ${dof.name}`;
  const base = {
    selection: { characterId, ...(joint !== undefined && { joint }) },
    ...(joint !== undefined && { dof: { characterId, dof: channel, name: dof.name } }),
  };
  if (target.kind === 'channel') return { ...base, text: `Channel ${channel}: ${of}` };
  const time = keysOf(driven).times[target.key];
  if (time === undefined) return undefined;
  return {
    ...base,
    selection: { ...base.selection, keys: [{ channel, indices: [target.key] }] },
    timeSeconds: time - character.timeOffsetSeconds,
    text: `Key ${target.key} of ${of}`,
  };
}

/** The files of a document, those of a character first, each path once. */
export function sourcesOf({ characters, unused }: Document, characterId: string | undefined): readonly SourceFile[] {
  const own = characters.filter(({ id }) => id === characterId);
  const all = [...own, ...characters].flatMap(({ sources }) => sources);
  const paths = new Map([...all, ...unused.map(({ file }) => file.source)].map((source) => [source.path, source]));
  return [...paths.values()];
}
