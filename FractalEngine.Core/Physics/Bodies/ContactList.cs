namespace FractalEngine.Core.Physics.Bodies;

/// <summary>A few contacts of one ball, in an array that is made once.</summary>
/// <param name="capacity">Maximum number of contacts.</param>
internal abstract class ContactList(int capacity)
{
    private protected readonly Contact[] _contacts = new Contact[capacity];

    /// <summary>Number of contacts at present.</summary>
    public int Count { get; private protected set; }

    /// <summary>The contact at an index from 0 to <see cref="Count"/> − 1.</summary>
    public ref readonly Contact this[int index] => ref _contacts[index];

    /// <summary>True where one of them is a surface that moves.</summary>
    public bool HasMovingSurface
    {
        get
        {
            var hasMoving = false;
            for (var i = 0; i < Count; i++)
            {
                hasMoving |= _contacts[i].Kinematic is { IsCarrying: true };
            }

            return hasMoving;
        }
    }

    /// <summary>Removes all contacts of the list.</summary>
    public void Clear() => Count = 0;
}
