/** A root with joints all around it: a skeleton as wide as another is long, whose joints turn at once. */

const REACH = 100;
/** Radians between neighbours on the spiral: the golden angle spreads points evenly over a sphere. */
const GOLDEN_ANGLE = Math.PI * (3 - Math.sqrt(5));
const TURN_DEGREES = 10;

/** A `.bvh` of so many joints, the root among them. */
export function star(joints: number): string {
  const rays = joints - 1;
  const around = Array.from({ length: rays }, (_, i) => {
    const z = 1 - (2 * (i + 0.5)) / rays;
    const radius = Math.sqrt(1 - z * z);
    const offset = [radius * Math.cos(i * GOLDEN_ANGLE), z, radius * Math.sin(i * GOLDEN_ANGLE)];
    const place = offset.map((value) => (REACH * value).toFixed(4)).join(' ');
    return `JOINT ray${i}\n{\nOFFSET ${place}\nCHANNELS 1 Zrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n`;
  });
  const frame = (degrees: number) => Array.from({ length: 6 + rays }, () => degrees).join(' ');
  return `HIERARCHY
ROOT root
{
OFFSET 0 0 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
${around.join('')}}
MOTION
Frames: 2
Frame Time: 0.5
${frame(0)}
${frame(TURN_DEGREES)}
`;
}
