/** A joint's own rule, with what its motion says (axes, order) worked out. */
export interface JointMotion {
  /** Writes J(φ) as 16 numbers at `out[o]`; φ begins at `dofs[first]`. */
  write(dofs: Float64Array, first: number, out: Float64Array, o: number): void;
  /**
   * Writes ∂J/∂φ of the joint's DOF number `dof` (0 is its first) as 16 numbers at `out[o]`: its last row is 0, and so
   * is its last column where the DOF moves no pivot.
   */
  writeDerivative(dofs: Float64Array, first: number, dof: number, out: Float64Array, o: number): void;
  /** Whether the 3×3 part of J can be anything but a rotation: scales and shear. */
  readonly stretches?: boolean;
  /**
   * Of a motion that doesn't stretch, the same derivatives in fewer numbers: with J = (R, t), each is ([ω]×·R, v).
   * Writes ωx ωy ωz vx vy vz a DOF at `out[0]`, in the space of J's result. Absent where no short cut is known;
   * `ik/twists.ts` then finds them from the derivatives.
   * @param j J(φ), as `write` made it, at `j[jo]`; its last column counts for nothing
   */
  writeTwists?(dofs: Float64Array, first: number, j: Float64Array, jo: number, out: Float64Array): void;
}
