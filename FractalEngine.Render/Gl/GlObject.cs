namespace FractalEngine.Render.Gl;

/// <summary>
/// Something that GL allocated and that exactly one owner disposes. There is no finalizer: it would run on a thread
/// without a context. What is forgotten is reported by name when the context ends.
/// </summary>
internal abstract class GlObject : IDisposable
{
    private bool _isDisposed;

    /// <summary>Registers an object.</summary>
    /// <param name="resources">Of the current context.</param>
    /// <param name="label">What it is for, for messages.</param>
    protected GlObject(GlResources resources, string label)
    {
        (Resources, Label) = (resources, label);
        resources.Add(this);
    }

    /// <summary>What the object is for.</summary>
    public string Label { get; }

    /// <summary>The registry of the context that the object belongs to.</summary>
    protected GlResources Resources { get; }

    /// <summary>Deletes the object, at once on the GL thread, else when that thread next draws. Harmless when repeated.</summary>
    public void Dispose()
    {
        if (!_isDisposed)
        {
            _isDisposed = true;
            Resources.Remove(this);
        }
    }

    /// <summary>Kind and label.</summary>
    public sealed override string ToString() => $"{GetType().Name} '{Label}'";

    internal void DeleteNow() => Delete();

    /// <summary>Calls the fitting glDelete. Runs once, on the GL thread.</summary>
    protected abstract void Delete();
}
