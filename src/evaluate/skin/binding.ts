/**
 * Checks whether parts of a character fit together, which can only be decided once both are present. Problems with a
 * position in a file were already found by the reader, so these diagnostics have none (line 0).
 */

import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Morph } from '../../model/morph.ts';
import { jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { bindingCount, type Skin, vertexCount } from '../../model/skin.ts';
import type { Take } from '../../model/takes/take.ts';

/** Whether every joint that the skin is attached to exists. */
export function checkSkin(skin: Skin, skeleton: Skeleton, fileName: string): Diagnostic[] {
  const joints = skeleton.joints.length;
  const bindings = bindingCount(skin);
  // No vertex is attached to a joint beyond the bindings, so usually there is nothing to search.
  if (bindings > 0 && bindings <= joints) return bindings < joints ? [bindingsFewer(bindings, skeleton, fileName)] : [];
  const culprit = skin.attachments ? firstNotBelow(skin.attachments.joints, joints) : -1;
  if (skin.attachments && culprit >= 0) {
    const { start, joints: jointOf } = skin.attachments;
    const vertex = ownerOf(start, culprit);
    const message = `Vertex ${vertex} is attached to joint ${jointOf[culprit]}, but ${named(skeleton)} has ${count(joints, 'joint')}${joints ? ` (0 to ${joints - 1})` : ''}.`;
    return [withoutPlace('error', 'joint-missing', message, fileName)];
  }
  if (bindings <= joints) return [];
  const message = `The skin has ${count(bindings, 'binding')}, but ${named(skeleton)} has ${count(joints, 'joint')}.`;
  const assumed = 'the extra bindings are used by no vertex and are ignored';
  return [withoutPlace('warning', 'bindings-more', message, fileName, assumed)];
}

function bindingsFewer(bindings: number, skeleton: Skeleton, fileName: string): Diagnostic {
  const joints = skeleton.joints.length;
  const message = `The skin has ${count(bindings, 'binding')}, but ${named(skeleton)} has ${count(joints, 'joint')}.`;
  const assumed = `joints from ${bindings} on move no vertex`;
  return withoutPlace('info', 'bindings-fewer', message, fileName, assumed);
}

/** Whether every vertex that the morph moves exists. */
export function checkMorph(morph: Morph, skin: Skin, fileName: string): Diagnostic[] {
  const vertices = vertexCount(skin);
  for (const what of ['positions', 'normals'] as const) {
    const { indices } = morph[what];
    const row = firstNotBelow(indices, vertices);
    if (row < 0) continue;
    const message = `Row ${row + 1} of the ${what} is for vertex ${indices[row]}, but ${named(skin)} has ${count(vertices, 'vertex', 'vertices')} (0 to ${vertices - 1}).`;
    return [withoutPlace('error', 'vertex-missing', message, fileName)];
  }
  return [];
}

/** Whether there are as many channels as root translation, joints and (if it drives any) morphs need. */
export function checkTake(take: Take, skeleton: Skeleton, morphCount: number, fileName: string): Diagnostic[] {
  const given = take.channels.length;
  const dofs = jointDofCount(skeleton);
  const forRoot = rootDofCount(skeleton);
  const forSkeleton = forRoot + dofs;
  const forAll = forSkeleton + morphCount;
  // An animation of the joints alone is complete, with or without morphs.
  if (given === forSkeleton || given === forAll) return [];
  const morphs = morphCount > 0 && given > forSkeleton ? ` and ${morphCount} for its morphs` : '';
  const needed = morphs ? forAll : forSkeleton;
  const message = `The animation has ${count(given, 'channel')}, but ${named(skeleton)} needs ${needed}: ${forRoot ? `${forRoot} for the root translation, ` : ''}${dofs} for its joints${morphs}.`;
  if (given < needed) {
    return [withoutPlace('warning', 'channels-fewer', message, fileName, 'DOFs without a channel keep their pose')];
  }
  const assumed = `the last ${count(given - forAll, 'channel')} are unused`;
  return [withoutPlace('warning', 'channels-more', message, fileName, assumed)];
}

/** Index of the first element that is at least `limit`; -1 if there is none. */
function firstNotBelow(indices: Uint32Array, limit: number): number {
  for (let i = 0; i < indices.length; i++) if (indices[i] >= limit) return i;
  return -1;
}

/** The vertex of attachment `a`: the v with start[v] ≤ a < start[v + 1]. */
function ownerOf(start: Uint32Array, a: number): number {
  let low = 0;
  let high = start.length - 1;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (start[middle + 1] > a) high = middle;
    else low = middle + 1;
  }
  return low;
}

function named({ name }: { readonly name: string }): string {
  return `"${name}"`;
}

function count(n: number, one: string, many = `${one}s`): string {
  return `${n} ${n === 1 ? one : many}`;
}
