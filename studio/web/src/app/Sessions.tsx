import { useEffect, useState } from "preact/hooks";
import { call } from "../net/connection";
import { Button } from "../ui/Button";
import { Dialog } from "../ui/Dialog";
import { Table } from "../ui/Table";
import { complain } from "../ui/toast";

interface Session {
  number: number;
  opened: string;
  from: string;
  agent: string;
  windows: number;
}

/** The browsers that were let in; each can be closed. */
export function Sessions({ open, onClose }: { open: boolean; onClose(): void }) {
  const [mine, setMine] = useState(0);
  const [sessions, setSessions] = useState<Session[]>([]);
  const read = async () => {
    const list = await call<{ mine: number; sessions: Session[] }>("studio.sessions");
    setMine(list.mine);
    setSessions(list.sessions);
  };
  const close = async (number: number) => {
    await call("studio.close_session", { number });
    await read();
  };
  useEffect(() => {
    if (open) read().catch(complain);
  }, [open]);
  return (
    <Dialog open={open} title="Sessions" onClose={onClose}>
      <p>
        Browsers that opened this studio's address. A browser can open the address again after you close its session. To make the address invalid, enter{" "}
        <code>asperity studio --new-token</code> in a terminal.
      </p>
      <Table
        caption="Sessions"
        testId="sessions"
        rows={sessions}
        rowKey={(session) => session.number}
        columns={[
          { key: "number", label: "Number" },
          { key: "opened", label: "Opened (UTC)" },
          { key: "from", label: "From" },
          { key: "agent", label: "Browser" },
          { key: "windows", label: "Windows", numeric: true },
          {
            key: "close",
            label: "Close",
            cell: ({ number }) =>
              number === mine ? (
                "this browser"
              ) : (
                <Button kind="danger" label={`Close session ${number}`} onClick={() => close(number)}>
                  Close
                </Button>
              ),
          },
        ]}
      />
    </Dialog>
  );
}
