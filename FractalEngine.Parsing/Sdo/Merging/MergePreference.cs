namespace FractalEngine.Parsing.Sdo.Merging;

/// <summary>Which side wins where both have changed the same declaration of a scene.</summary>
public enum MergePreference
{
    /// <summary>Neither side: the declaration is reported as a conflict.</summary>
    None,

    /// <summary>The side that saves.</summary>
    Mine,

    /// <summary>The side that is in the file.</summary>
    Theirs,
}
