namespace FractalEngine.Render.Preparation;

/// <summary>The triangles of a model that one draw call makes: those of one material.</summary>
/// <param name="FirstIndex">The place in the model's indices where they begin.</param>
/// <param name="IndexCount">Three for each triangle.</param>
/// <param name="Material">Null for faces without one: they have the object's own colour.</param>
public readonly record struct DrawableBatch(int FirstIndex, int IndexCount, DrawableMaterial? Material)
{
    /// <summary>Whether what lies behind shows through.</summary>
    public bool IsTransparent => Material is { IsTransparent: true };
}
