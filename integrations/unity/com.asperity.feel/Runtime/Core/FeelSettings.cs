using System;
using System.Collections.Generic;
using System.Globalization;

namespace Asperity.Feel
{
    /// <summary>
    /// How a scene is rendered: the names of `asperity feel --set render.NAME=VALUE` without "render.", and "rate_Hz".
    /// </summary>
    public sealed class FeelSettings : IDisposable
    {
        internal readonly SettingsHandle Handle;

        public FeelSettings()
        {
            IntPtr settings;
            Native.Check(Native.asperity_settings_create(out settings));
            Handle = new SettingsHandle(settings);
        }

        /// <summary>Sets one by its name; returns this, so that several can be set in one expression.</summary>
        public FeelSettings Set(string name, string value)
        {
            Native.Check(Native.asperity_settings_set(Handle, Native.Utf8(name), Native.Utf8(value)));
            return this;
        }

        public FeelSettings Set(string name, double value)
        {
            return Set(name, value.ToString("R", CultureInfo.InvariantCulture));
        }

        /// <summary>All names with their meaning and unit.</summary>
        public static IEnumerable<KeyValuePair<string, string>> All
        {
            get
            {
                ulong count = Native.asperity_settings_count().ToUInt64();
                for (ulong i = 0; i < count; ++i)
                {
                    yield return new KeyValuePair<string, string>(Native.Text(Native.asperity_settings_name(new UIntPtr(i))),
                                                                  Native.Text(Native.asperity_settings_help(new UIntPtr(i))));
                }
            }
        }

        public void Dispose() { Handle.Dispose(); }
    }
}
