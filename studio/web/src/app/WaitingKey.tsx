import { keyGroups, leader } from "../ui/keys";

/** What may follow the first of two keys, while it waits. In the page once. */
export function WaitingKey() {
  const first = leader.value;
  const keys = first ? keyGroups.value.flatMap((group) => group.keys).filter(({ key }) => key.startsWith(`${first} `)) : [];
  return (
    <div role="status" data-testid="waiting-key">
      {first && (
        <div class="waiting-key">
          <p>
            <kbd>{first.toUpperCase()}</kbd>, then
          </p>
          <ul>
            {keys.map(({ key, label }) => (
              <li key={key}>
                <kbd>{key.slice(first.length + 1).toUpperCase()}</kbd> {label}
              </li>
            ))}
            <li>
              <kbd>Esc</kbd> stay here
            </li>
          </ul>
        </div>
      )}
    </div>
  );
}
