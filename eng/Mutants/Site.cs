using Microsoft.CodeAnalysis.Text;

namespace FractalEngine.Mutants;

/// <summary>One way to change a site.</summary>
/// <param name="Operator">Name of the mutation operator.</param>
/// <param name="Text">What stands at the site then.</param>
internal sealed record Change(string Operator, string Text);

/// <summary>How the original and the mutant stand side by side in the copy.</summary>
internal enum Form
{
    /// <summary>A conditional expression chooses.</summary>
    Expression,

    /// <summary>An if-statement chooses between two statements.</summary>
    Statement,

    /// <summary>An if-statement chooses between two bodies of the whole member: right wherever the mutant itself compiles.</summary>
    Body,
}

/// <summary>A body that can stand twice.</summary>
/// <param name="Span">Place of the body, or of the arrow with its expression.</param>
/// <param name="Expression">Place of the expression after the arrow; null for a block.</param>
/// <param name="IsVoid">Whether nothing is returned.</param>
/// <param name="IsProperty">Whether the arrow stands for a whole getter.</param>
internal sealed record Body(TextSpan Span, TextSpan? Expression, bool IsVoid, bool IsProperty);

/// <summary>A place of the source that can be changed.</summary>
internal sealed class Site
{
    /// <summary>Path relative to the checkout, with slashes.</summary>
    public required string Path { get; init; }

    /// <summary>Types and member around the site, with the types of parameters.</summary>
    public required string Member { get; init; }

    /// <summary>The span that is replaced.</summary>
    public required TextSpan Span { get; init; }

    /// <summary>The text that is replaced.</summary>
    public required string Original { get; init; }

    /// <summary>The form to try first.</summary>
    public required Form Form { get; init; }

    /// <summary>The body around the site; null in initialisers.</summary>
    public required Body? Body { get; init; }

    /// <summary>All ways to change it.</summary>
    public List<Change> Changes { get; } = [];

    /// <summary>Number of sites before it in the same member with the same text.</summary>
    public int Occurrence { get; set; }

    /// <summary>Name of the site that stays when lines move, and when the file moves to another folder.</summary>
    public string Key => $"{Path[(Path.LastIndexOf('/') + 1)..]}|{Member}|{OneLine}|{Occurrence}";

    /// <summary>The replaced text with single spaces only.</summary>
    public string OneLine => string.Join(' ', Original.Split((char[]?)null, StringSplitOptions.RemoveEmptyEntries));
}

/// <summary>A site with the change that was drawn.</summary>
internal sealed class Mutation(Site site, Change change)
{
    /// <summary>The place that is changed.</summary>
    public Site Site { get; } = site;

    /// <summary>The change that was drawn.</summary>
    public Change Change { get; } = change;

    /// <summary>The form in which it stands in the copy.</summary>
    public Form Form { get; set; } = site.Form;

    /// <summary>Name that stays when lines move.</summary>
    public string Id { get; } = IdOf(site, change);

    /// <summary>Its number in the copy.</summary>
    public int Number { get; set; }

    /// <summary>Name of the group that it counts for.</summary>
    public string Group { get; set; } = "";

    /// <summary>Makes the name from a site and a change.</summary>
    public static string IdOf(Site site, Change change) => Hashing.Hex($"{site.Key}|{change.Operator}", 10);
}
