//! The elements of a part's text, one after the other, with the line they stand in.

use std::borrow::Cow;
use std::str::FromStr;

use quick_xml::{
    Reader, XmlVersion,
    events::{BytesStart, Event},
};

use super::{ThreeMfError, archive::xml_fault};

/// Reads the tags of a text in their order.
pub struct Scanner<'a> {
    part: &'a str,
    text: &'a str,
    reader: Reader<&'a [u8]>,
}

/// Where in a package something stands.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    part: &'a str,
    text: &'a str,
    /// How far the text was read, bytes.
    offset: usize,
}

/// A tag that opens an element, or is one by itself, or closes one.
pub struct Tag<'a> {
    /// Where it stands.
    pub place: Place<'a>,
    /// What kind of tag it is.
    pub kind: Kind,
    content: BytesStart<'a>,
}

/// Which kind of tag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Elements may follow inside of it.
    Open,
    /// An element without content.
    Empty,
    /// The end of an element.
    Close,
}

impl<'a> Scanner<'a> {
    /// The tags of the text of that part.
    pub fn new(part: &'a str, text: &'a str) -> Self {
        Self {
            part,
            text,
            reader: Reader::from_str(text),
        }
    }

    /// The next tag; none at the end of the text. A document type is refused: it could declare
    /// entities that grow without end.
    pub fn next_tag(&mut self) -> Result<Option<Tag<'a>>, ThreeMfError> {
        loop {
            let event = self.reader.read_event();
            let place = Place {
                part: self.part,
                text: self.text,
                offset: self.reader.buffer_position() as usize,
            };
            let (kind, content) = match event.map_err(|error| place.fault(&error.to_string()))? {
                Event::Start(start) => (Kind::Open, start),
                Event::Empty(start) => (Kind::Empty, start),
                Event::End(_) => (Kind::Close, BytesStart::new("")),
                Event::DocType(_) => return Err(place.document_type()),
                Event::Eof => return Ok(None),
                _ => continue,
            };
            return Ok(Some(Tag {
                place,
                kind,
                content,
            }));
        }
    }

    /// Passes over all that is inside of the element that was just opened.
    pub fn skip(&mut self, opened: &Tag) -> Result<(), ThreeMfError> {
        let mut depth = usize::from(opened.kind == Kind::Open);
        while depth > 0 {
            match self.next_tag()?.map(|tag| tag.kind) {
                Some(Kind::Open) => depth += 1,
                Some(Kind::Close) => depth -= 1,
                Some(Kind::Empty) => {}
                None => return Err(self.cut()),
            }
        }
        Ok(())
    }

    /// Calls `child` with every element that lies directly in the one that was opened; it must read
    /// what is inside of it.
    pub fn children(
        &mut self,
        opened: &Tag,
        mut child: impl FnMut(&mut Self, Tag<'a>) -> Result<(), ThreeMfError>,
    ) -> Result<(), ThreeMfError> {
        if opened.kind != Kind::Open {
            return Ok(());
        }
        loop {
            match self.next_tag()?.ok_or_else(|| self.cut())? {
                tag if tag.kind == Kind::Close => return Ok(()),
                tag => child(self, tag)?,
            }
        }
    }

    /// The text ends within an element.
    fn cut(&self) -> ThreeMfError {
        let end = Place {
            part: self.part,
            text: self.text,
            offset: self.text.len(),
        };
        end.fault("the text ends before its elements do")
    }
}

impl Place<'_> {
    /// The line, from 1.
    fn line(&self) -> usize {
        let read = &self.text.as_bytes()[..self.offset.min(self.text.len())];
        1 + read.iter().filter(|&&byte| byte == b'\n').count()
    }

    fn fault(&self, reason: &str) -> ThreeMfError {
        xml_fault(self.part, self.line(), reason)
    }

    fn document_type(&self) -> ThreeMfError {
        ThreeMfError::DocumentType {
            part: self.part.to_owned(),
            line: self.line(),
        }
    }
}

/// How much of a faulty attribute is shown, characters.
const MAX_QUOTED: usize = 40;

impl Tag<'_> {
    /// Its name without a prefix; empty for the end of an element.
    pub fn name(&self) -> &str {
        self.content.local_name().into_inner()
    }

    /// The attribute of that full name; none without it.
    pub fn get(&self, name: &str) -> Result<Option<Cow<'_, str>>, ThreeMfError> {
        self.find(|key| key == name)
    }

    /// The attribute of that name in some namespace but the element's own; none without it.
    pub fn prefixed(&self, name: &str) -> Result<Option<Cow<'_, str>>, ThreeMfError> {
        self.find(|key| key.split_once(':').is_some_and(|(_, local)| local == name))
    }

    /// The value of the first attribute whose name is wanted.
    fn find(&self, is_wanted: impl Fn(&str) -> bool) -> Result<Option<Cow<'_, str>>, ThreeMfError> {
        for attribute in self.content.attributes() {
            let attribute = attribute.map_err(|error| self.place.fault(&error.to_string()))?;
            if is_wanted(attribute.key.into_inner()) {
                let value = attribute.normalized_value(XmlVersion::Explicit1_0);
                return value
                    .map(Some)
                    .map_err(|error| self.place.fault(&error.to_string()));
            }
        }
        Ok(None)
    }

    /// The number that an attribute must hold.
    pub fn number<T: FromStr>(&self, wanted: &Wanted) -> Result<T, ThreeMfError> {
        let text = self.get(wanted.attribute)?.unwrap_or_default();
        text.trim().parse().map_err(|_| self.not(wanted, &text))
    }

    /// The fault that an attribute is not what it must be.
    pub fn not(&self, wanted: &Wanted, found: &str) -> ThreeMfError {
        ThreeMfError::Attribute {
            part: self.place.part.to_owned(),
            line: self.place.line(),
            element: wanted.element,
            attribute: wanted.attribute,
            expected: wanted.expected,
            found: found.chars().take(MAX_QUOTED).collect(),
        }
    }

    /// The names that the element declares for namespaces, with the namespaces.
    pub fn namespaces(&self) -> Vec<(String, String)> {
        let declared = self.content.attributes().flatten().filter_map(|attribute| {
            let prefix = attribute.key.into_inner().strip_prefix("xmlns:")?;
            Some((prefix.to_owned(), attribute.value.into_owned()))
        });
        declared.collect()
    }
}

/// What an attribute must be.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// The element it belongs to.
    pub element: &'static str,
    /// Its name.
    pub attribute: &'static str,
    /// What it must hold, in words.
    pub expected: &'static str,
}
