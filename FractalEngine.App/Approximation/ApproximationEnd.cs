namespace FractalEngine.App.Approximation;

/// <summary>What ended the search for a fractal.</summary>
internal enum ApproximationEnd
{
    /// <summary>There was nothing left to look for.</summary>
    Search,

    /// <summary>The time that <c>--seconds</c> gives was over.</summary>
    Time,

    /// <summary>A signal, such as that of Ctrl+C.</summary>
    Interruption,
}
