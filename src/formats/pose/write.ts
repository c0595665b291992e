/** Writes `.pose`. */
import type { PoseByNames } from '../../model/pose-by-names.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** Writes a `.pose`. @param fileName appears in diagnostics */
export function writePoses(poses: readonly PoseByNames[], fileName = ''): WriteResult {
  const text = new Text(fileName);
  for (const { name, root, joints, weights } of poses) {
    text.about(`pose "${name}"`);
    text.line(0, `pose${text.lineName(name, 'pose')} {`);
    if (root) text.line(1, `root ${text.numbers(root)}`);
    for (const joint of joints) {
      const dofs = joint.dofs.map((dof) => `${dof.name} ${text.number(dof.value)}`);
      text.line(1, `joint${text.lineName(joint.name, 'joint')} { ${[...dofs, '}'].join(' ')}`);
    }
    for (const weight of weights)
      text.line(1, `weight ${text.number(weight.value)}${text.lineName(weight.name, 'morph')}`);
    text.line(0, '}');
  }
  return text.result();
}
