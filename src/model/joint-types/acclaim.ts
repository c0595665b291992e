/** Bones of Acclaim skeletons. */
import type { Vec3 } from '../../math/vec3.ts';
import { ACCLAIM_DOFS, type AcclaimMotion, type CompoundDof, EULER_ORDERS } from '../skeleton/skeleton.ts';
import { dof } from './dof.ts';
import type { JointType } from './type.ts';

/** Those of a kind, of which the last is applied first. */
function factorsOf({ dofs }: AcclaimMotion, kind: 't' | 'r'): readonly CompoundDof[] {
  return dofs.flatMap((name) => (name !== 'l' && name.startsWith(kind) ? [name] : []));
}

const turnsOf = (motion: AcclaimMotion) => factorsOf(motion, 'r').toReversed();

/** Without axes of its own, or a length: one-DOF matrices, translations first. */
function plainFactors(motion: AcclaimMotion): readonly CompoundDof[] | undefined {
  const isPlain = !motion.dofs.includes('l') && motion.axes.every((angle) => angle === 0);
  return isPlain ? [...factorsOf(motion, 't'), ...turnsOf(motion)] : undefined;
}

/** The joint of a `.asf`: the DOFs of its bone, in the file's order, about axes of its own. */
export const ACCLAIM: JointType<AcclaimMotion> = {
  keyword: 'bone',
  format: 'asf',
  initial: { kind: 'acclaim', dofs: [], axes: [0, 0, 0], order: 'xyz', frame: 'bone' },
  parameters: {
    dofs: { type: 'list', subject: 'The DOFs of a bone', choices: ACCLAIM_DOFS },
    axes: { type: 'angles', subject: 'The axes of a bone', label: 'Axes' },
    order: { type: 'choice', subject: 'The order of the axes', choices: EULER_ORDERS, describe: (order) => order },
    frame: {
      type: 'choice',
      subject: 'The frame of a bone',
      choices: ['bone', 'root'],
      describe: (frame) => frame,
    },
  },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: ({ dofs }) => dofs.map(dof),
  factors: plainFactors,
  turns: turnsOf,
  carriesCharacter: ({ dofs }) => (['tx', 'ty', 'tz'] as const).every((name) => dofs.includes(name)),
  mirrored(motion, across) {
    const [x, y, z] = motion.axes.map((angle, k) => (k === across ? angle : 0 - angle));
    const axes: Vec3 = [x, y, z];
    return { ...motion, axes };
  },
};
