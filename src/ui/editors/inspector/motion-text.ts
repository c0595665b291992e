/** What kinds of joints are called in the inspector: by the words of the files, with what else is said of them there. */
import type { Motion } from '../../../model/skeleton.ts';

/** `hingejoint, axis 1 1 0.5`. */
export function motionText(motion: Motion): string {
  switch (motion.kind) {
    case 'ball':
      return `balljoint, order ${motion.order}`;
    case 'hinge':
      return `hingejoint, axis ${motion.axis.join(' ')}`;
    case 'universal':
      return `universaljoint, order ${motion.order}`;
    case 'quaternion':
      return 'quaternionjoint';
    case 'prismatic':
      return `prismaticjoint, axis ${motion.axis.join(' ')}`;
    case 'translational':
      return 'translationaljoint';
    case 'free':
      return `freejoint, order ${motion.order}`;
    case 'screw':
      return `screwjoint, axis ${motion.axis.join(' ')}, ${motion.pitch} a turn`;
    case 'scale': {
      const isAlong = motion.mode === 'axis' || motion.mode === 'volume';
      return `scalejoint, mode ${motion.mode}${isAlong ? `, axis ${motion.axis.join(' ')}` : ''}`;
    }
    case 'shear':
      return 'shearjoint';
    case 'fixed':
      return 'fixedjoint';
    case 'compound':
      return motion.dofs.length ? `compoundjoint, ${motion.dofs.join(' ')}` : 'compoundjoint without DOFs';
    case 'bvh':
      return bvhText(motion);
  }
}

function bvhText({ channels, positions }: Extract<Motion, { kind: 'bvh' }>): string {
  if (channels.length === 0) return 'BVH joint without channels';
  const moves = channels.some((channel) => channel.startsWith('t'));
  const meaning = positions === 'add' ? ', added to its offset' : ', in place of its offset';
  return `BVH joint, channels ${channels.join(' ')}${moves ? meaning : ''}`;
}

/** The same for a heading: `hinge, axis 1 1 0.5`; no more of motion capture than its channels. */
export function briefMotion(motion: Motion): string {
  if (motion.kind === 'bvh') return motion.channels.join(' ') || 'no channels';
  return motionText(motion).replace(/^(\w+)joint\b/, '$1');
}
