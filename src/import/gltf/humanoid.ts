/**
 * Which nodes are which part of the body, in files that say so: VRM 0.x, VRM 1.0, and VRM animations. Their names of
 * parts are the same, `leftUpperArm`, `hips`, but for the thumb's, which are given as in 1.0.
 */
import { countOf, type Document, extensionOf, listOf, objectOf, textOf } from './json.ts';

/** Node → part of the body, as VRM calls it. */
export function readHumanoid({ root }: Document): ReadonlyMap<number, string> {
  const roles = new Map<number, string>();
  const add = (node: unknown, role: string | undefined) => {
    const index = countOf(node);
    if (index !== undefined && role) roles.set(index, role);
  };
  for (const bone of listOf(objectOf(extensionOf(root, 'VRM')?.humanoid)?.humanBones)) {
    const role = textOf(objectOf(bone)?.bone);
    const [, thumb, part] = /^(.*Thumb)(Proximal|Intermediate)$/.exec(role ?? '') ?? [];
    add(objectOf(bone)?.node, thumb ? `${thumb}${part === 'Proximal' ? 'Metacarpal' : 'Proximal'}` : role);
  }
  for (const name of ['VRMC_vrm', 'VRMC_vrm_animation']) {
    const bones = objectOf(objectOf(extensionOf(root, name)?.humanoid)?.humanBones);
    for (const [role, bone] of Object.entries(bones ?? {})) add(objectOf(bone)?.node, role);
  }
  return roles;
}
