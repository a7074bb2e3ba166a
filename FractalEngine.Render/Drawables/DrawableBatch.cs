namespace FractalEngine.Render.Drawables;

/// <summary>The triangles of a model that share a material, and are drawn by one call.</summary>
/// <param name="FirstIndex">Position of the batch's first index in <see cref="DrawableModel.Indices"/>.</param>
/// <param name="IndexCount">Number of indices of the batch, three a triangle.</param>
/// <param name="Material">Material of the triangles; null for the object's own colour.</param>
public readonly record struct DrawableBatch(int FirstIndex, int IndexCount, DrawableMaterial? Material)
{
    /// <summary>True where the surface behind shows through.</summary>
    public bool IsTransparent => Material is { IsTransparent: true };

    /// <summary>True where nothing behind the triangles can be seen through them.</summary>
    public bool IsSolid => Material is null or { IsTransparent: false, IsCutOut: false };
}
