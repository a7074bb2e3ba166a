using FractalEngine.Core;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <content>Finds declared names, and proposes one for a name that is not declared.</content>
public sealed partial class FractalParser
{
    private DeclaredObject FindObject(Cursor cursor, string name) =>
        _objects.TryGetValue(name, out var value) ? value
        : throw Error(cursor, $"the object '{name}' is not declared above{AskAboutObject(name)}");

    private TransformationFunction FindFunction(Cursor cursor, string name) =>
        _functions.TryGetValue(name, out var function) ? function
        : throw Error(cursor, $"the transformation '{name}' is not declared above{AskAboutFunction(name)}");

    private string AskAboutObject(string name)
    {
        if (_functions.ContainsKey(name))
        {
            return $": '{name}' is a transformation, and its calls stand in brackets";
        }

        var (stem, digits) = SplitDigits(name);
        return digits.Length > 0 && _objects.GetValueOrDefault(stem) is DeclaredRecursive
            ? $": did you mean '{stem} {digits}'?"
            : NameSuggestion.Ask(name, _objects.Keys);
    }

    private string AskAboutFunction(string name)
    {
        if (_objects.ContainsKey(name))
        {
            return $": '{name}' is an object, and a set ends with ']' before it";
        }

        var (stem, digits) = SplitDigits(name);
        return digits.Length > 0 && _functions.ContainsKey(stem)
            ? $": did you mean '{stem}.{digits}'?"
            : NameSuggestion.Ask(name, _functions.Keys);
    }

    /// <summary>Splits a name such as <c>t12</c> into its stem and the digits at its end.</summary>
    private static (string Stem, string Digits) SplitDigits(string name)
    {
        var stem = name.TrimEnd(['0', '1', '2', '3', '4', '5', '6', '7', '8', '9']);
        return (stem, name[stem.Length..]);
    }
}
