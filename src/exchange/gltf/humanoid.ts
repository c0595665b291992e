/**
 * Which nodes are which part of the body, in files that say so: VRM 0.x, VRM 1.0, and VRM animations. Their names of
 * parts are nearly the same: `leftUpperArm`, `hips`; VRM 1.0 counts the thumb differently.
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
    add(objectOf(bone)?.node, textOf(objectOf(bone)?.bone));
  }
  for (const name of ['VRMC_vrm', 'VRMC_vrm_animation']) {
    const bones = objectOf(objectOf(extensionOf(root, name)?.humanoid)?.humanBones);
    for (const [role, bone] of Object.entries(bones ?? {})) add(objectOf(bone)?.node, role);
  }
  return roles;
}
