/** Something that is not as it should be, but can be lived with. */
export function Warning({ words }: { words: string }) {
  return (
    <p class="warning">
      <strong>Note: </strong>
      {words.charAt(0).toUpperCase() + words.slice(1)}
    </p>
  );
}
