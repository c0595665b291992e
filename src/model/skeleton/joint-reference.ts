/** How files refer to joints: by name, or `#7` by index where names aren't unique. */

interface Named {
  readonly name: string;
}

/** Whether a reference is an index: `#7`. */
export function isJointIndex(reference: string): boolean {
  return /^#\d+$/.test(reference);
}

/** The reference to each joint: its name if no other joint has it, and it looks like no index; else `#index`. */
export function jointReferences(joints: readonly Named[]): readonly string[] {
  const counts = new Map<string, number>();
  for (const { name } of joints) counts.set(name, (counts.get(name) ?? 0) + 1);
  return joints.map(({ name }, index) => (name && counts.get(name) === 1 && !isJointIndex(name) ? name : `#${index}`));
}

/** Finds the joint that a reference means: the first of its name; undefined if there is none. */
export function jointReferred(joints: readonly Named[]): (reference: string) => number | undefined {
  const byName = new Map<string, number>();
  joints.forEach(({ name }, index) => {
    if (name && !byName.has(name)) byName.set(name, index);
  });
  return (reference) => {
    if (!isJointIndex(reference)) return byName.get(reference);
    const index = Number(reference.slice(1));
    return index < joints.length ? index : undefined;
  };
}
