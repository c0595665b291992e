/**
 * Mistakes of solvers of inverse kinematics. They aren't rules of a program that gives one right pose, as those of the
 * catalogue are: any solution is right, so what is tried is whether a mistaken step gives the other program's numbers.
 */
export type IkMistake = 'ik-step-unscaled' | 'ik-step-degrees' | 'ik-jacobian-transposed' | 'ik-end-effector';

/** Formulas of the assignment. */
export const IK_FORMULAS: Readonly<Record<IkMistake, string>> = {
  'ik-step-unscaled': 'Δφ = α·Jᵀe, α = e·(JJᵀe) / |JJᵀe|²',
  'ik-step-degrees': 'φ ← φ + Δφ, both in radians',
  'ik-jacobian-transposed': 'Δφᵢ = α·(∂p/∂φᵢ)·e: column i of J times e',
  'ik-end-effector': 'e = target − p, J = ∂p/∂φ, p = W·x of the end effector',
};
