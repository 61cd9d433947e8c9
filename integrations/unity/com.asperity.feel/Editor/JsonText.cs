using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Text;

namespace Asperity.Feel.Editor
{
    /// <summary>
    /// JSON as dictionaries, lists, strings, doubles, booleans and null. Unity's own JsonUtility needs a class for each
    /// file, and no class has a texture's block, whose name is the model's.
    /// </summary>
    internal sealed class JsonText
    {
        private const int DeepestLevel = 64;
        private readonly string text, name;
        private int at, level;

        private JsonText(string text, string name)
        {
            this.text = text;
            this.name = name;
        }

        /// <summary>Throws IOException with `name` and the position for what is no JSON.</summary>
        internal static object Parse(string text, string name)
        {
            JsonText reader = new JsonText(text, name);
            object value = reader.Value();
            reader.Blanks();
            if (reader.at != text.Length) throw reader.Fault("text after the end");
            return value;
        }

        private IOException Fault(string what) { return new IOException(name + ": no JSON at character " + (at + 1) + ": " + what); }

        private void Blanks()
        {
            while (at < text.Length && " \t\r\n".IndexOf(text[at]) >= 0) ++at;
        }

        private char Next()
        {
            Blanks();
            if (at == text.Length) throw Fault("the text ends");
            return text[at];
        }

        private bool Take(char letter)
        {
            if (Next() != letter) return false;
            ++at;
            return true;
        }

        private void Expect(char letter)
        {
            if (!Take(letter)) throw Fault("'" + letter + "' is missing");
        }

        private object Value()
        {
            switch (Next())
            {
                case '{': return Deeper(Members);
                case '[': return Deeper(Items);
                case '"': return Letters();
                default: return Word();
            }
        }

        private delegate object Inner();

        private object Deeper(Inner read)
        {
            if (++level > DeepestLevel) throw Fault("more than " + DeepestLevel + " levels");
            ++at;
            object value = read();
            --level;
            return value;
        }

        private object Members()
        {
            Dictionary<string, object> members = new Dictionary<string, object>();
            if (Take('}')) return members;
            do
            {
                if (Next() != '"') throw Fault("a name is missing");
                string key = Letters();
                Expect(':');
                members[key] = Value();
            } while (Take(','));
            Expect('}');
            return members;
        }

        private object Items()
        {
            List<object> items = new List<object>();
            if (Take(']')) return items;
            do items.Add(Value()); while (Take(','));
            Expect(']');
            return items;
        }

        private object Word()
        {
            int from = at;
            while (at < text.Length && ",]} \t\r\n:".IndexOf(text[at]) < 0) ++at;
            string word = text.Substring(from, at - from);
            double number;
            if (word == "true") return true;
            if (word == "false") return false;
            if (word == "null") return null;
            if (double.TryParse(word, NumberStyles.Float, CultureInfo.InvariantCulture, out number)) return number;
            at = from;
            throw Fault("'" + word + "' is no value");
        }

        private string Letters()
        {
            StringBuilder letters = new StringBuilder();
            for (++at; at < text.Length && text[at] != '"'; ++at) letters.Append(text[at] == '\\' ? Escaped() : text[at]);
            if (at == text.Length) throw Fault("a text does not end");
            ++at;
            return letters.ToString();
        }

        // At the backslash; ends at the last character of what it begins.
        private char Escaped()
        {
            const string Named = "\"\\/bfnrt", Meant = "\"\\/\b\f\n\r\t";
            ++at;
            int named = at < text.Length ? Named.IndexOf(text[at]) : -1;
            if (named >= 0) return Meant[named];
            int code;
            if (at + 4 >= text.Length || text[at] != 'u' ||
                !int.TryParse(text.Substring(at + 1, 4), NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture, out code))
                throw Fault("an unknown escape");
            at += 4;
            return (char)code;
        }
    }
}
