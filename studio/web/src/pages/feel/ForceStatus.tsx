/** The state of the forces and their stop, in the header of all pages. */
export function ForceStatus() {
  return null;
}
