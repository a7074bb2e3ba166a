using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Reads fractal files (paper §4.2.2): vectors, transformation functions, objects and recursives, and the one result marked by
/// <c>&lt;$&gt;</c>. The grammar is in docs/manual.md. Nothing is expanded, so the result is as small as the file.
/// </summary>
public sealed class FractalParser : RecursiveParser
{
    private (Composition Value, int Offset)? _composition;
    private (DeclaredObject Object, int Offset)? _result;
    private (Gradient Gradient, int Offset)? _gradient;
    private (Handedness Value, int Offset)? _handedness;
    private bool _hasDeclaration;

    private protected override string? Explain(SyntaxFailure failure) => ExplainOutput(failure) ?? FractalMistakes.Explain(failure);

    private FractalParser(SourceText source, FractalNumberList? numbers, bool keepsSums = false)
        : base(source, numbers, keepsSums)
    {
    }

    /// <summary>Parses a whole fractal file. The file of the base mesh is not read.</summary>
    /// <param name="source">Text of the file.</param>
    /// <param name="values">Numbers that take the place of those that the file gives to names; null for none.</param>
    /// <exception cref="SourceException">The text is not a fractal, or has no valid meaning.</exception>
    /// <exception cref="ArgumentException">A number is not finite.</exception>
    public static ParsedFractal Parse(SourceText source, IReadOnlyDictionary<string, double>? values = null)
    {
        if (values?.Values.All(double.IsFinite) == false)
        {
            throw new ArgumentException("expected finite numbers", nameof(values));
        }

        var parsed = new FractalParser(source, null) { Overrides = values }.ParseFile();
        // Few files have choices, and these take no second time of note.
        return parsed.Description.HasChance ? ParseKeepingSums(source, values) : parsed;
    }

    /// <summary>Parses a file that may name another one with chance in it: all sums and sets stay as they are written then.</summary>
    internal static ParsedFractal ParseKeepingSums(SourceText source, IReadOnlyDictionary<string, double>? values) =>
        new FractalParser(source, null, keepsSums: true) { Overrides = values }.ParseFile() with { KeepsSums = true };

    /// <summary>Parses a file, and lists its numbers.</summary>
    internal static ImmutableArray<FractalNumber> FindNumbers(SourceText source)
    {
        var numbers = new FractalNumberList();
        new FractalParser(source, numbers).ParseFile();
        return numbers.Complete();
    }

    private ParsedFractal ParseFile()
    {
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, out cursor))
            {
                throw SyntaxError();
            }
        }

        RequireVectors();
        if (_result is not { } result)
        {
            throw _hasDeclaration
                ? Source.Error(Source.Text.TrimEnd().Length, "the fractal has no result: expected a declaration '<$>. object'")
                : Source.Error(0, "the fractal declares nothing");
        }

        var steps = result.Object.Steps;
        var description = Bases.Parts.Describe(
            result.Object.Part, steps.Take(steps.Count), _composition?.Value ?? Composition.Affine, out var meshes);
        RequirePartLimits(description, meshes.Length, result.Offset);
        if (FractalCheck.FindCompositionFault(description) is { } fault)
        {
            throw Source.Error(result.Offset, fault);
        }

        return new(Source, description, ImmutableArray.CreateRange(meshes, mesh => Bases.References[mesh]), result.Offset)
        {
            Gradient = _gradient?.Gradient,
            Handedness = _handedness?.Value,
            NumberNames = NumberNames,
            Warnings = Hints,
        };
    }

    private bool ParseLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        return ParseComment(start, out rest)
            || ((IsAtEndOfLine(start) || ParseDeclaration(start, out rest)) && ParseEndOfLine(rest, out rest));
    }

    private bool ParseDeclaration(Cursor cursor, out Cursor rest)
    {
        _hasDeclaration = true;
        return ParseVectorDeclaration(cursor, out rest)
            || ParseResult(cursor, out rest)
            || ParseSetting(
                cursor, "composition", "composition", [(Composition.Affine, "affine"), (Composition.Componentwise, "componentwise")],
                ref _composition, out rest)
            || ParseGradient(cursor, out rest)
            || ParseSetting(
                cursor, "handed", "handedness", [(Handedness.Left, "left"), (Handedness.Right, "right")], ref _handedness, out rest)
            || ParseSeed(cursor, out rest)
            || ParseValueDeclaration(cursor, out rest)
            || ParseMatrix(cursor, out rest)
            || ParseFunction(cursor, out rest)
            || ParseRecursives(cursor, out rest)
            || ParseObjectDeclaration(cursor, out rest);
    }

    /// <summary>Parses <c>gradient level "moss"</c>, as objects of scenes have it.</summary>
    private bool ParseGradient(Cursor cursor, out Cursor rest)
    {
        if (!ParseWordAndBlank(cursor, "gradient", out rest) || !char.IsLetter(rest.Current))
        {
            return false;
        }

        RequireOnce(cursor, "gradient", _gradient?.Offset);
        _gradient = (GradientParser.ParseIn(Source, rest, out rest), cursor.Offset);
        return true;
    }

    /// <summary>Parses a choice that a file makes at most once, such as <c>handed right</c>: a keyword, and one of some words.</summary>
    private bool ParseSetting<T>(
        Cursor cursor, string keyword, string what, ReadOnlySpan<(T Value, string Word)> choices, ref (T Value, int Offset)? chosen,
        out Cursor rest)
        where T : struct
    {
        if (!ParseWordAndBlank(cursor, keyword, out rest) || !ParseChoice(rest, choices, out var value, out rest))
        {
            return false;
        }

        RequireOnce(cursor, what, chosen?.Offset);
        chosen = (value, cursor.Offset);
        return true;
    }

    private void RequireOnce(Cursor cursor, string what, int? firstOffset)
    {
        if (firstOffset is { } first)
        {
            throw Error(cursor, $"the {what} is declared twice, first in line {Source.LineOf(first)}");
        }
    }

    /// <summary>Parses the result of the file: <c>&lt;$&gt;. object</c>.</summary>
    private bool ParseResult(Cursor cursor, out Cursor rest)
    {
        rest = cursor;
        if (!cursor.Rest.StartsWith("<$>", StringComparison.Ordinal))
        {
            return Fail(cursor, "'<$>'");
        }

        if (!ParseChar(cursor.Advance(3), '.', out rest) || !ParseBlanks(rest, out rest) || !ParseAny(rest, out var value, out rest))
        {
            return false;
        }

        RequireOnce(cursor, "result '<$>'", _result?.Offset);
        RequireLimit(value.Steps.LevelCount, FractalLimits.Levels.Value, "the fractal", "levels", cursor);
        var digits = FractalSteps.EstimateDigits(value.Steps.Take(value.Steps.Count));
        RequireLimit(digits, FractalLimits.Digits.Value, "the number of instances", "digits", cursor);
        _result = (value, cursor.Offset);
        return true;
    }

    private void RequirePartLimits(FractalDescription description, int baseCount, int offset)
    {
        if (baseCount > ParsingLimits.BaseFiles.Value)
        {
            throw Source.Error(
                offset, $"the fractal has more than the limit of {ParsingLimits.BaseFiles.Value} base meshes", isLimitExceeded: true);
        }

        if (!description.Parts.IsEmpty && FractalLimits.FindExceeded(description) is var (limit, things))
        {
            throw Source.Error(offset, $"the fractal has more than the limit of {limit.Value} {things}", isLimitExceeded: true);
        }
    }

    /// <summary>Parses a named object: <c>name. object</c>.</summary>
    private bool ParseObjectDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseBlanks(rest, out rest) || !BeginObject(name) || (rest.Current == '(' && !Parentheses.HoldObject(rest.Rest))
            || !ParseAny(rest, out var value, out rest))
        {
            return false;
        }

        Names.Add(cursor, name, value);
        return true;
    }
}
