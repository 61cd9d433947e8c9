import { useEffect, useState } from "preact/hooks";
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { ConfigForm, type ConfigField } from "../../ui/ConfigForm";
import { Panel } from "../../ui/Panel";
import { complain } from "../../ui/toast";
import { align } from "./alignState";

/** All settings of the registration. */
export function SettingsPanel() {
  const [fields, setFields] = useState<ConfigField[]>([]);
  const config = align.value?.config;
  const key = JSON.stringify(config ?? {});
  useEffect(() => void call<ConfigField[]>("align.config").then(setFields, complain), [key]);
  const set = (path: string, text: string | null) => {
    const { [path]: _old, ...others } = config ?? {};
    void edit("/align/config", text === null ? others : { ...others, [path]: text }, `set ${path}`).catch(complain);
  };
  return (
    <Panel title="Settings" collapsible open={false} testId="align-settings">
      <ConfigForm fields={fields} onChange={set} />
    </Panel>
  );
}
