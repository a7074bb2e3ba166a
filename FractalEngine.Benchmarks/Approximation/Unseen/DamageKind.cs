namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>What may be done to a model before a search gets it; all of them shuffle it at last.</summary>
internal enum DamageKind
{
    /// <summary>Nothing but shuffling: the order of vertices, faces and corners, and a tenth of the faces turned.</summary>
    None,

    /// <summary>Each vertex is moved by up to a fraction of the smallest element.</summary>
    Noise,

    /// <summary>Each vertex is moved by up to a fraction of the diagonal of the model.</summary>
    NoiseOfDiagonal,

    /// <summary>A fraction of the elements is missing.</summary>
    Missing,

    /// <summary>A fraction of the elements is missing, and others of the same bases stand at random places.</summary>
    MissingAndStrangers,

    /// <summary>A fraction of the edges is split at a random point of each.</summary>
    SplitEdges,

    /// <summary>A fraction of the edges between faces of one plane is flipped to the other diagonal.</summary>
    FlippedEdges,

    /// <summary>Edges are collapsed until a fraction of the faces is left.</summary>
    Decimated,

    /// <summary>Vertices at one place are welded across elements, and of faces with equal corners one is left.</summary>
    Welded,
}
