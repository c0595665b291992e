/** Which files are takes that can be reviewed by the hundred: those that hold all of a take, by their names. */
export function isReviewable(path: string): boolean {
  return /\.(bvh|fbx|glb|vrma)$/i.test(path);
}
