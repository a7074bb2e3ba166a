using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>The names that a fractal file has declared so far. An object and a transformation may have the same name.</summary>
/// <param name="source">Text of the file.</param>
/// <param name="bases">Receives the shapes that are named.</param>
internal sealed class DeclaredNames(SourceText source, DeclaredBases bases)
{
    private readonly Dictionary<string, (TransformationFunction Value, int Offset)> _functions = [];
    private readonly Dictionary<string, (DeclaredObject Value, int Offset)> _objects = [];

    // A file may declare another object of such a name.
    private readonly Dictionary<string, DeclaredObject> _shapes = [];

    /// <summary>The transformations, in the order of the file.</summary>
    public IEnumerable<TransformationFunction> Functions => _functions.Values.Select(static declared => declared.Value);

    /// <summary>Adds an object under its name.</summary>
    /// <exception cref="SourceException">Another one has the name, or there are too many.</exception>
    public void Add(Cursor cursor, string name, DeclaredObject value) => Add(_objects, "object", cursor, name, value);

    /// <summary>Adds a transformation under its name.</summary>
    /// <exception cref="SourceException">Another one has the name, or there are too many.</exception>
    public void Add(Cursor cursor, string name, TransformationFunction function) =>
        Add(_functions, "transformation", cursor, name, function);

    /// <summary>Returns the object with a name.</summary>
    /// <exception cref="SourceException">There is none above the cursor: the message proposes another name.</exception>
    public DeclaredObject FindObject(Cursor cursor, string name) =>
        _objects.TryGetValue(name, out var declared) ? declared.Value
        : FindShape(cursor, name) is { } shape ? shape
        : throw source.Error(cursor.Offset, $"the object '{name}' is not declared above{AskAboutObject(name)}");

    /// <summary>Tells whether an object that was declared has a name.</summary>
    public bool HasObject(string name) => _objects.ContainsKey(name);

    /// <summary>Tells whether a recursive has a name.</summary>
    public bool IsRecursive(string name) => _objects.GetValueOrDefault(name).Value is DeclaredRecursion;

    /// <summary>Returns the one object of a shape, wherever it is named; null for other names.</summary>
    private DeclaredObject? FindShape(Cursor cursor, string name)
    {
        if (!_shapes.TryGetValue(name, out var shape) && BaseShapes.TryFind(name, out _))
        {
            shape = bases.Add(name, cursor.Offset);
            _shapes.Add(name, shape);
        }

        return shape;
    }

    /// <summary>Finds the transformation with a name.</summary>
    public bool TryFindFunction(string name, [NotNullWhen(true)] out TransformationFunction? function)
    {
        var isFound = _functions.TryGetValue(name, out var declared);
        function = declared.Value;
        return isFound;
    }

    /// <summary>Creates the error of a name that no transformation above the cursor has: it proposes another name.</summary>
    public SourceException UnknownFunction(Cursor cursor, string name) =>
        source.Error(
            cursor.Offset, $"the transformation '{name}' is not declared above{AskAboutFunction(name, cursor.Peek(name.Length) == '.')}");

    private void Add<T>(Dictionary<string, (T Value, int Offset)> names, string kind, Cursor cursor, string name, T value)
    {
        if (_objects.Count + _functions.Count >= ParsingLimits.Names.Value)
        {
            throw source.Error(
                cursor.Offset, $"the file has more than the limit of {ParsingLimits.Names.Value} names", isLimitExceeded: true);
        }

        if (!names.TryAdd(name, (value, cursor.Offset)))
        {
            throw source.Error(
                cursor.Offset, $"the {kind} '{name}' is declared twice, first in line {source.LineOf(names[name].Offset)}");
        }
    }

    private string AskAboutObject(string name)
    {
        if (_functions.ContainsKey(name))
        {
            return $": '{name}' is a transformation, and its calls stand in brackets";
        }

        var (stem, digits) = SplitDigits(name);
        return name.ToUpperInvariant() switch
        {
            "SPHERE" => ": did you mean 'ball'?",
            "CUBE" => ": did you mean 'box'?",
            "PLANE" or "QUAD" or "SQUARE" => ": did you mean 'plate'?",
            _ => null,
        } ?? (digits.Length > 0 && IsRecursive(stem)
            ? $": did you mean '{stem} {digits}'?"
            : NameSuggestion.Ask(name, [.. _objects.Keys, .. BaseShapes.Names]));
    }

    private string AskAboutFunction(string name, bool isCall)
    {
        if (_objects.ContainsKey(name) || BaseShapes.TryFind(name, out _))
        {
            return $": '{name}' is an object, and {(isCall ? "a set holds maps" : "a set ends with ']' before it")}";
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
